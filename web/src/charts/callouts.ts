// Where labels go that name points of a curve: near their point, inside the plot, and not over each other. Pure.

export interface Callout {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  /** Above its point (a peak), or below it (a dip). */
  readonly above: boolean;
}
export interface Placed {
  readonly left: number;
  readonly top: number;
}

/** @param size height of a label, px. @returns one place for each label; null where there is no room for it. */
export function place(
  labels: readonly Callout[],
  { width, height, size }: { width: number; height: number; size: number },
): readonly (Placed | null)[] {
  const taken: (Placed & { width: number })[] = [];
  const gap = 0.6 * size;
  return labels.map((label) => {
    const left = Math.max(0, Math.min(width - label.width, label.x - label.width / 2));
    const [up, down] = [label.y - gap - size, label.y + gap];
    const first = label.above ? [up, down] : [down, up];
    const steps = [0, 1, 2, 3].map((n) => n * 1.15 * size);
    const tries = steps.flatMap((step) => first.map((top) => (top === up ? top - step : top + step)));
    const top = tries.find(
      (tried) =>
        tried >= 0 &&
        tried + size <= height &&
        taken.every((t) => left + label.width < t.left || left > t.left + t.width || Math.abs(tried - t.top) >= size),
    );
    if (top === undefined) return null;
    taken.push({ left, top, width: label.width });
    return { left, top };
  });
}
