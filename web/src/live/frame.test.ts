import { describe, expect, it } from "vitest";
import { decodeFrame, FrameError, HEADER_BYTES } from "./frame";

// Bytes written by hand from the table in docs/wire.md, not by an encoder of our own.
const TWO_BY_TWO = [
  1,
  1,
  2,
  0, // version, kind, two channels
  2,
  0,
  0,
  0, // two samples
  0x15,
  0x3d,
  0x01,
  0,
  0,
  0,
  0,
  0, // tick 81,173
  0x2c,
  0x01,
  0,
  0, // 300 ticks lost
  3,
  0,
  0,
  0, // subscription 3
  0,
  0,
  0x80,
  0x3f,
  0,
  0,
  0,
  0xc0, // 1.0, −2.0
  0,
  0,
  0xc0,
  0x7f,
  0,
  0,
  0x7a,
  0x44, // NaN, 1000.0
];
const bytes = (list: number[]): ArrayBuffer => new Uint8Array(list).buffer;

describe("decodeFrame", () => {
  it("reads header and columns in the order of the subscription", () => {
    const frame = decodeFrame(bytes(TWO_BY_TWO));
    expect(frame).toMatchObject({ firstTick: 81173, samples: 2, lostTicks: 300, subscription: 3 });
    expect(frame.columns.map((column) => [...column])).toEqual([
      [1, -2],
      [NaN, 1000],
    ]);
  });

  it("reads ticks beyond 32 bits: the loop may run for years", () => {
    const long = [...TWO_BY_TWO];
    long[13] = 1;
    expect(decodeFrame(bytes(long)).firstTick).toBe(2 ** 40 + 81173);
  });

  it("accepts a frame without samples, which only tells of a loss", () => {
    const empty = TWO_BY_TWO.slice(0, HEADER_BYTES);
    empty[4] = 0;
    expect(decodeFrame(bytes(empty))).toMatchObject({ samples: 0, lostTicks: 300 });
  });

  it.each([
    ["another version", [2, ...TWO_BY_TWO.slice(1)], /version 2/],
    ["another kind", [1, 9, ...TWO_BY_TWO.slice(2)], /kind 9/],
    ["a missing byte", TWO_BY_TWO.slice(0, -1), /39 bytes, 40 expected/],
    ["a byte too many", [...TWO_BY_TWO, 0], /41 bytes, 40 expected/],
    ["half a header", TWO_BY_TWO.slice(0, 12), /no whole header/],
  ])("refuses %s", (_, list, message) => {
    expect(() => decodeFrame(bytes(list))).toThrow(FrameError);
    expect(() => decodeFrame(bytes(list))).toThrow(message);
  });
});
