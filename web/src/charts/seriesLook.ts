// How several series of one chart are told apart: by colour, and by the shape of their points.

const COLOURS = 6;
const SHAPES = ["circle", "square", "triangle", "diamond"] as const;
export type Shape = (typeof SHAPES)[number];

/** The CSS variable of the colour of a series. */
export const seriesColour = (index: number): string => `--series-${(index % COLOURS) + 1}`;
export const shapeOf = (index: number): Shape => SHAPES[index % SHAPES.length]!;

/** Adds the outline of a mark to a path; also of the little picture in a legend. */
export function outline(path: Path2D, shape: Shape, x: number, y: number, radius: number): void {
  if (shape === "circle") {
    path.moveTo(x + radius, y);
    path.arc(x, y, radius, 0, 2 * Math.PI);
    return;
  }
  const corners = CORNERS[shape];
  corners.forEach(([dx, dy], i) => (i === 0 ? path.moveTo : path.lineTo).call(path, x + dx * radius, y + dy * radius));
  path.closePath();
}

const CORNERS: Record<Exclude<Shape, "circle">, readonly (readonly [number, number])[]> = {
  square: [
    [-0.9, -0.9],
    [0.9, -0.9],
    [0.9, 0.9],
    [-0.9, 0.9],
  ],
  triangle: [
    [0, -1.15],
    [1.1, 0.85],
    [-1.1, 0.85],
  ],
  diamond: [
    [0, -1.3],
    [1.3, 0],
    [0, 1.3],
    [-1.3, 0],
  ],
};

/** The same as the path of an SVG of 10 × 10. */
export const MARKS: Record<Shape, string> = {
  circle: "M8 5a3 3 0 1 0-6 0a3 3 0 1 0 6 0Z",
  square: "M2.3 2.3H7.7V7.7H2.3Z",
  triangle: "M5 1.6L8.3 7.6H1.7Z",
  diamond: "M5 1.1L8.9 5L5 8.9L1.1 5Z",
};
