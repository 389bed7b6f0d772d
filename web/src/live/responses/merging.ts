// Points of a frequency response as they come while it runs, into what was read of it before. Pure.

import type { FrequencyResponse, ResponseFrame, ResponsePoint, ResponseSeries } from "./types";

const SAME = 1e-6;

/** Takes a point in; the one that it is newer than gives way. Of another transfer it changes nothing. */
export function merged(response: FrequencyResponse, { block, transfer, point }: ResponseFrame): FrequencyResponse {
  if (transfer !== response.transfer) return response;
  const at = response.series.findIndex((series) => series.block === block && belongs(series, point));
  const series =
    at < 0
      ? [...response.series, begun(block, point)]
      : response.series.map((one, i) => (i === at ? { ...one, points: withPoint(one.points, point) } : one));
  return { ...response, series };
}

/** A point that was too high is played smaller, and stays one of the amplitude that was asked for. */
const belongs = ({ amplitude_n, mean_n }: ResponseSeries, point: ResponsePoint): boolean =>
  Math.abs(mean_n - point.mean_n) <= SAME * Math.max(1, Math.abs(mean_n)) &&
  Math.abs(amplitude_n - point.asked_n) <= SAME * amplitude_n;

const begun = (block: number, point: ResponsePoint): ResponseSeries => ({
  ...{ block, method: point.amplitude_m === null ? "stepped_sine" : "multisine", amplitude_m: point.amplitude_m },
  ...{ amplitude_n: point.asked_n, mean_n: point.mean_n },
  points: [point],
  extremes: { peak: null, dip: null, minus_3_db_hz: null, minus_90_deg_hz: null },
});

const isAt = (point: ResponsePoint, hz: number): boolean => Math.abs(point.frequency_hz - hz) <= SAME * hz;

function withPoint(points: readonly ResponsePoint[], point: ResponsePoint): ResponsePoint[] {
  const others = points.filter((one) => !isAt(one, point.frequency_hz));
  return [...others, point].sort((a, b) => a.frequency_hz - b.frequency_hz);
}
