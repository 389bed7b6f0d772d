// "Run again": the revision that ran is chosen, whatever the test has become since.

import { entry } from "./entry.svelte";
import { stage } from "./stage.svelte";
import { tests } from "./tests.svelte";
import type { Run } from "./types";

export function chooseAgain({ test_id, revision }: Run): void {
  tests.chosenId = test_id;
  entry.again = revision === null ? null : { testId: test_id, revision };
  stage.putAway();
}
