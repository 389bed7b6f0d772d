// Minimum and maximum of every column of ticks, so that no peak is ever lost between two pixels.

/** Extremes of one column, in the order in which they happened; NaN where the column holds no sample. */
export interface Extremes {
  first: number;
  second: number;
}

/**
 * Extremes of the ticks [fromTick, toTick) of a ring whose sample of tick t is at `t % values.length`.
 * NaN (lost ticks) are left out. Writes into `out`, allocates nothing.
 */
export function extremes(values: Float32Array, fromTick: number, toTick: number, out: Extremes): void {
  const size = values.length;
  let low = Infinity;
  let high = -Infinity;
  let lowAt = -1;
  let highAt = -1;
  let tick = fromTick;
  while (tick < toTick) {
    const at = tick % size;
    const end = Math.min(size, at + (toTick - tick));
    const shift = tick - at;
    for (let i = at; i < end; i += 1) {
      const value = values[i]!; // a NaN fails both comparisons
      if (value < low) {
        low = value;
        lowAt = shift + i;
      }
      if (value > high) {
        high = value;
        highAt = shift + i;
      }
    }
    tick += end - at;
  }
  if (lowAt < 0 && highAt < 0) {
    out.first = out.second = NaN;
    return;
  }
  out.first = lowAt <= highAt ? low : high;
  out.second = lowAt <= highAt ? high : low;
}

/** How many ticks share a column: 1 (every sample is drawn) as long as there are at most two samples a pixel. */
export function bucketTicks(windowTicks: number, pixels: number): number {
  if (pixels < 1 || windowTicks <= 2 * pixels) return 1;
  return Math.ceil(windowTicks / pixels);
}

/**
 * Column by column extremes of a whole span: two numbers a column, in time order.
 * Columns start at multiples of `bucket`, so that a column keeps its samples while the window moves on.
 */
export function decimate(
  values: Float32Array,
  fromTick: number,
  toTick: number,
  bucket: number,
): Float32Array {
  const firstColumn = Math.floor(fromTick / bucket);
  const columns = toTick > fromTick ? Math.ceil(toTick / bucket) - firstColumn : 0;
  const result = new Float32Array(2 * columns);
  const out = { first: 0, second: 0 };
  for (let i = 0; i < columns; i += 1) {
    const start = (firstColumn + i) * bucket;
    extremes(values, Math.max(fromTick, start), Math.min(toTick, start + bucket), out);
    result[2 * i] = out.first;
    result[2 * i + 1] = out.second;
  }
  return result;
}
