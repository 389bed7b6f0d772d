import { describe, expect, it } from "vitest";
import { judge, sentence, type Signs } from "./freshness";

const GOOD: Signs = {
  socketOpen: true,
  statusAt_s: 100,
  samplesAt_s: 100,
  loopAlive: true,
  loopAge_s: 0.004,
  loopStarting: false,
};
const at = (now_s: number, change: Partial<Signs> = {}): ReturnType<typeof judge> =>
  judge({ ...GOOD, ...change }, now_s);

describe("judge", () => {
  it("believes fresh data and tells their age", () => {
    expect(at(100.1)).toEqual({ stale: false, trouble: null, age_s: expect.closeTo(0.104, 6) as number });
  });

  it("stops believing one second after the last status", () => {
    expect(at(100.99).stale).toBe(false);
    expect(at(101.01, { samplesAt_s: 101 })).toMatchObject({ stale: true, trouble: "link" });
  });

  it("stops believing one second after the last sample, even when status goes on", () => {
    expect(at(101.5, { statusAt_s: 101.45 })).toMatchObject({ stale: true, trouble: "samples", age_s: 1.5 });
  });

  it("stops believing at once when the socket closes", () => {
    expect(at(100.01, { socketOpen: false })).toMatchObject({ stale: true, trouble: "link" });
  });

  it("names the loop, not the link, when the loop died", () => {
    expect(at(100.05, { loopAlive: false, loopAge_s: 1.2 })).toMatchObject({ stale: true, trouble: "loop" });
    expect(at(100.05, { loopAge_s: 1.2 })).toMatchObject({ stale: true, trouble: "loop" });
    expect(at(100.05, { loopAlive: null })).toMatchObject({ stale: true, trouble: "loop" });
  });

  it("tells a loop that starts from one that died", () => {
    const fresh = at(100.05, { loopAlive: false, loopAge_s: null, loopStarting: true });
    expect(fresh).toMatchObject({ stale: true, trouble: "starting" });
    expect(sentence(fresh)).toBe("No data yet: the loop process is starting");
  });

  it("says so before anything came", () => {
    expect(at(100, { statusAt_s: null })).toEqual({ stale: true, trouble: "connecting", age_s: null });
  });
});

describe("sentence", () => {
  it("says for how long and why", () => {
    expect(sentence(at(103.2, { socketOpen: false }))).toBe("No data for 3 s: link to the server lost");
    expect(sentence(at(100, { loopAlive: false, loopAge_s: 7 }))).toBe("No data for 7 s: loop process lost");
    expect(sentence(at(100 + 300, { socketOpen: false }))).toBe("No data for 5 min: link to the server lost");
    expect(sentence(at(100, { statusAt_s: null }))).toBe("No data yet: connecting to the server");
    expect(sentence(at(100.1))).toBe("");
  });
});
