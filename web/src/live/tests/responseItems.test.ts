import { describe, expect, it } from "vitest";
import { BLOCK_KINDS, keysOf, kindOf, type Block } from "./kinds";

const response: Block = { kind: "frequency_response", amplitudes_n: [2000], frequencies_hz: [10, 20] };
const info = kindOf(response, "blocks")!;
const keys = (method: string): string[] => keysOf(info, { ...response, method });

describe("the form of a frequency response", () => {
  it("asks of each method what that knows, and nothing of the other", () => {
    const adaptive = ["settle", "confidence", "auto_level", "auto_resolution"];
    expect(keys("stepped_sine")).toEqual(expect.arrayContaining([...adaptive, "means_n", "bands"]));
    expect(keys("multisine")).toEqual(expect.arrayContaining(["realisations", "lines", "means_n", "bands"]));
    expect(keys("stepped_sine").filter((key) => keys("multisine").includes(key))).toEqual([
      ...["method", "amplitudes_n", "means_n", "frequencies_hz", "settle_cycles", "measure_cycles", "bands"],
    ]);
  });
  it("drops with a choice all that the other alone knows", () => {
    const method = info.items.find((item) => item.form === "choice" && item.key === "method");
    const drops = method?.form === "choice" ? method.drops! : {};
    expect(keys("stepped_sine").filter((key) => !keys("multisine").includes(key))).toEqual(drops["multisine"]);
    expect(keys("multisine").filter((key) => !keys("stepped_sine").includes(key))).toEqual(drops["stepped_sine"]);
  });
  it("says in a line how much is measured, and whether it adapts", () => {
    const said = info.summary({ ...response, means_n: [0, 5000], confidence: { gain_db: 0.1 } });
    expect(said).toBe("adaptive stepped sine, 2 × 2 frequencies");
    expect(BLOCK_KINDS.filter(({ kind }) => kind === "frequency_response")).toHaveLength(1);
  });
});
