import { describe, expect, it, vi } from "vitest";
import { Problem } from "./api";
import { deliver, underName } from "./stopping";

const never = (): Promise<never> => new Promise(() => {});
const refused = new Problem("You may not.", "not_allowed", 403);

describe("deliver", () => {
  it("is done with the first way that arrives, however slow the other one is", async () => {
    expect(await deliver([never, async () => "taken"])).toBeNull();
    expect(await deliver([async () => "taken", never])).toBeNull();
  });

  it("does not wait for the other way where one has failed for good", async () => {
    const failing = vi.fn().mockRejectedValue(new TypeError("Failed to fetch"));
    expect(await deliver([failing, async () => "taken"])).toBeNull();
  });

  it("tries a lost one again, and one that was understood not", async () => {
    const lost = vi.fn().mockRejectedValueOnce(new Problem("", "no_answer", null)).mockResolvedValue("taken");
    expect(await deliver([lost])).toBeNull();
    expect(lost).toHaveBeenCalledTimes(2);
    const understood = vi.fn().mockRejectedValue(refused);
    expect(await deliver([understood])).toBe(refused);
    expect(understood).toHaveBeenCalledOnce();
  });

  it("tells what the interface said where no way led anywhere", async () => {
    const dead = vi.fn().mockRejectedValue(new TypeError("Failed to fetch"));
    expect(await deliver([async () => Promise.reject(refused), dead])).toBe(refused);
    expect(dead).toHaveBeenCalledTimes(3);
  });
});

describe("underName", () => {
  it("keeps port and path, and takes the name that the page has", () => {
    expect(underName("http://127.0.0.1:8001/stop", "localhost")).toBe("http://localhost:8001/stop");
    expect(underName("https://0.0.0.0:8001/stop", "rig.lab")).toBe("https://rig.lab:8001/stop");
  });
});
