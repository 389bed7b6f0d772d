import { expect, it } from "vitest";
import { injectedWords } from "./strip";
import type { DrillSummary } from "./types";

const given = (fault: string, given_by: string): DrillSummary => ({ fault, given_by }) as unknown as DrillSummary;

it("says what is injected, and by whom where that is known", () => {
  const records = [given("pump_loss", "Ann"), given("load_cell_frozen", "Eva"), given("load_cell_frozen", "Bo")];
  expect(injectedWords(["load_cell_frozen"], records)).toBe("load cell frozen is injected by Eva.");
  expect(injectedWords(["load_cell_frozen"], [])).toBe("load cell frozen is injected.");
  expect(injectedWords(["valve_stuck", "pump_loss"], records)).toBe("valve stuck, pump loss are injected by Ann.");
});
