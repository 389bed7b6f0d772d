import { describe, expect, it } from "vitest";
import { limitsNear, overlayExtent, predicted } from "./overlays";

describe("overlays", () => {
  const trace = { time_s: [0, 1, 2], min: [-5, null, -1], max: [5, null, 9] };

  it("reach as far as they do within the window", () => {
    expect(overlayExtent([predicted(trace)], { from_s: 0, to_s: 2 })).toEqual({ low: -5, high: 9 });
    expect(overlayExtent([predicted(trace)], { from_s: 0, to_s: 1 })).toEqual({ low: -5, high: 5 });
    expect(overlayExtent([], { from_s: 0, to_s: 1 })).toEqual({ low: Infinity, high: -Infinity });
  });

  it("leave out limits that would make the data small", () => {
    expect(limitsNear([-55, 55], -40, 40)).toEqual([-55, 55]);
    expect(limitsNear([-55, 55], -4, 4)).toEqual([]);
    expect(limitsNear([150], 155, 210)).toEqual([150]);
  });
});
