// Marks of a logarithmic axis: 1, 2, 5, 10 … labelled, the others between as grid. Pure.

export interface LogTicks {
  /** Where the grid is, upwards. */
  readonly at: readonly number[];
  /** Which of them have a label: as many as there is room for. */
  readonly labelled: ReadonlySet<number>;
}

const CHOICES: readonly (readonly number[])[] = [[1, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 5], [1, 3], [1]];
const LEAST_ON_A_LOG_AXIS = 3; // fewer marks than this in view: evenly spaced ones say more

/** @param room how many labels fit beside each other. */
export function logTicks(min: number, max: number, room: number): LogTicks {
  const [from, to] = [Math.floor(Math.log10(min)), Math.ceil(Math.log10(max))];
  const decades = Array.from({ length: to - from + 1 }, (_, i) => from + i);
  const inView = (steps: readonly number[]): number[] =>
    decades.flatMap((decade) => steps.map((step) => round(step * 10 ** decade))).filter((at) => at >= min && at <= max);
  const at = inView(CHOICES[0]!);
  if (at.length < LEAST_ON_A_LOG_AXIS) return even(min, max, room);
  const fitting = CHOICES.map(inView).find((marks) => marks.length > 0 && spread(marks, min, max) <= room);
  return { at, labelled: new Set(fitting ?? thinned(inView([1]), room)) };
}

/** As many labels as would fit if all were as near as the two nearest. */
function spread(marks: readonly number[], min: number, max: number): number {
  const gaps = marks.slice(1).map((mark, i) => Math.log(mark / marks[i]!));
  return gaps.length === 0 ? 1 : Math.log(max / min) / Math.min(...gaps);
}

/** Every second decade, or every third … */
const thinned = (marks: readonly number[], room: number): readonly number[] =>
  marks.filter((_, i) => i % Math.ceil(marks.length / room) === 0);

const STEPS = [1, 2, 5, 10] as const;

function even(min: number, max: number, room: number): LogTicks {
  const least = (max - min) / Math.max(2, Math.min(room, 6));
  const decade = 10 ** Math.floor(Math.log10(least));
  const step = (STEPS.find((factor) => factor * decade >= least) ?? 10) * decade;
  const first = Math.ceil(min / step - 1e-9);
  const at = Array.from({ length: Math.floor(max / step + 1e-9) - first + 1 }, (_, i) => round((first + i) * step));
  return { at, labelled: new Set(at) };
}

const round = (value: number): number => Number(value.toPrecision(12));
