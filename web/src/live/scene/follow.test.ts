import { describe, expect, it } from "vitest";
import { Follower } from "./follow";

describe("following what changes fast", () => {
  const told: number[] = [];
  const pauses: (() => void)[] = [];
  const answers: (() => void)[] = [];
  const follower = new Follower<number>(
    (value) => {
      told.push(value);
      return new Promise((answered) => answers.push(answered));
    },
    50,
    (then) => pauses.push(then),
  );
  const settled = (): Promise<void> => new Promise((done) => setTimeout(done));

  it("tells the first at once, and of those that come meanwhile the newest", async () => {
    follower.follow(1);
    follower.follow(2);
    follower.follow(3);
    expect(told).toEqual([1]);
    answers.shift()!();
    await settled();
    expect(told).toEqual([1]);
    pauses.shift()!();
    expect(told).toEqual([1, 3]);
  });

  it("is quiet once everything is told, and goes on with what comes", async () => {
    answers.shift()!();
    await settled();
    pauses.shift()!();
    expect(told).toEqual([1, 3]);
    follower.follow(4);
    expect(told).toEqual([1, 3, 4]);
  });
});
