import { describe, expect, it } from "vitest";
import { aDetector } from "../interlocks/aDetector";
import { found, settables, shown } from "./paths";

describe("what a re-run can change", () => {
  const all = settables({
    controller: { k_p: 0.02, compensation: { k_v: 1 }, name: "as shipped" },
    rig: { supply: { high_pa: 21e6 }, ports: [1, 2] },
    interlocks: { detectors: [aDetector({ threshold: 55e3, persistence_s: 0.05 })] },
  });
  const of = (path: string): (typeof all)[number] => all.find((one) => one.path === path)!;

  it("is every single value, by its path and in words", () => {
    expect(all.map(({ path }) => path)).toEqual([
      "controller.k_p",
      "controller.compensation.k_v",
      "controller.name",
      "interlocks.force.threshold",
      "interlocks.force.persistence_s",
      "interlocks.force.action",
      "interlocks.force.enabled",
      "rig.supply.high_pa",
    ]);
    expect(of("rig.supply.high_pa").label).toBe("Rig, Supply: high");
  });

  it("is shown in the units of the control room", () => {
    expect(shown(of("rig.supply.high_pa")).replace("\u00a0", " ")).toBe("210.00 bar");
    expect(shown(of("interlocks.force.threshold")).replace("\u00a0", " ")).toBe("55.000 kN");
    expect(shown(of("interlocks.force.persistence_s")).replace("\u00a0", " ")).toBe("50.0 ms");
    expect(shown(of("controller.k_p"))).toBe("0.02");
    expect(shown(of("interlocks.force.enabled"))).toBe("true");
  });

  it("is found by words, in any order", () => {
    expect(found(all, "thres force").map(({ path }) => path)).toEqual(["interlocks.force.threshold"]);
    expect(found(all, "")).toHaveLength(all.length);
    expect(found(all, "nothing")).toEqual([]);
  });
});
