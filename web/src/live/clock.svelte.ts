// The time of day, for what counts seconds and minutes on the screen.

const EVERY_MS = 500;

class Clock {
  now_ms = $state(Date.now());

  constructor() {
    window.setInterval(() => (this.now_ms = Date.now()), EVERY_MS);
  }
}

export const clock = new Clock();
