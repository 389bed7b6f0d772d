// Histograms of the loop's times, as they are drawn. Pure.

import type { Histogram } from "./types";

/** Bars side by side: `counts[i]` lies between `edges_s[i]` and `edges_s[i + 1]`. */
export interface Bars {
  readonly edges_s: readonly number[];
  readonly counts: readonly number[];
  /** How many were longer than the histogram reaches. */
  readonly beyond: number;
}

const LEAST_S = 50e-6;

/** The filled part of a histogram in at most `most` bars; each bar holds a whole number of bins. */
export function bars({ counts, bin_s }: Pick<Histogram, "counts" | "bin_s">, most: number): Bars {
  const last = counts.length - 1; // this bin has no upper end
  const filled = counts.slice(0, last).findLastIndex((count) => count > 0) + 1;
  const shown = Math.min(last, Math.max(filled, Math.ceil(LEAST_S / bin_s - 1e-9)));
  const width = Math.max(1, Math.ceil(shown / most));
  const drawn = Math.ceil(shown / width);
  const sum = (i: number): number =>
    counts.slice(i * width, Math.min(last, (i + 1) * width)).reduce((total, count) => total + count, 0);
  return {
    edges_s: Array.from({ length: drawn + 1 }, (_, i) => i * width * bin_s),
    counts: Array.from({ length: drawn }, (_, i) => sum(i)),
    beyond: counts[last] ?? 0,
  };
}

/** What was added since an earlier reading of the same life. */
export function since(now: Histogram, before: Histogram): Histogram {
  const counts = now.counts.map((count, i) => count - (before.counts[i] ?? 0));
  const at = (share: number): number | null => quantile_s(counts, now.bin_s, share);
  return { ...now, counts, p50_s: at(0.5), p99_s: at(0.99), p999_s: at(0.999), longest_s: at(1) };
}

/** The time that a share of the counts does not exceed, interpolated; null where it is beyond the last bin. */
export function quantile_s(counts: readonly number[], bin_s: number, share: number): number | null {
  const rank = share * counts.reduce((total, count) => total + count, 0);
  if (rank === 0) return null;
  let before = 0;
  for (const [i, count] of counts.slice(0, -1).entries()) {
    if (count > 0 && before + count >= rank) return (i + (rank - before) / count) * bin_s;
    before += count;
  }
  return null;
}
