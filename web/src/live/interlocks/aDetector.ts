// A detector for tests.

import { NEW_DETECTOR } from "./draft";
import type { Detector, LiveDetector } from "./types";

export const aDetector = (changes: Partial<Detector> = {}): Detector => ({
  ...NEW_DETECTOR,
  name: "force",
  threshold: 55e3,
  action: "shutdown",
  ...changes,
});

export const aReading = (changes: Partial<LiveDetector> = {}): LiveDetector => ({
  name: "force",
  value: 11e3,
  margin_share: 0.8,
  violated_s: 0,
  state: "content",
  first_out: false,
  trips: 0,
  ...changes,
});
