// Editing notes, tags and operator of a run: what changed, and what another changed meanwhile. Pure.

import { tagsIn } from "./choosing";
import type { Annotation } from "./book";

/** What is in the fields. */
export interface Draft {
  readonly operator: string;
  readonly tags: string;
  readonly notes: string;
}

export type Saving =
  | { readonly is: "idle" | "saving" | "saved" }
  | { readonly is: "conflict" }
  | { readonly is: "failed"; readonly why: string };

export const draftOf = ({ operator, tags, notes }: Annotation): Draft => ({
  operator,
  tags: tags.join(", "),
  notes,
});

/** Only what differs from what was read: another's edit of another field is not undone. */
export function changesOf(before: Annotation, draft: Draft): Partial<Annotation> {
  const tags = tagsIn(draft.tags);
  return {
    ...(draft.operator.trim() === before.operator ? {} : { operator: draft.operator.trim() }),
    ...(tags.join() === [...before.tags].sort().join() ? {} : { tags }),
    ...(draft.notes === before.notes ? {} : { notes: draft.notes }),
  };
}

export const isChanged = (before: Annotation, draft: Draft): boolean =>
  Object.keys(changesOf(before, draft)).length > 0;

/** After a conflict: fields that I did not touch take the other's text, those that I did keep mine. */
export function rebased(before: Annotation, draft: Draft, theirs: Annotation): Draft {
  const mine = changesOf(before, draft);
  const other = draftOf(theirs);
  return {
    operator: mine.operator === undefined ? other.operator : draft.operator,
    tags: mine.tags === undefined ? other.tags : draft.tags,
    notes: mine.notes === undefined ? other.notes : draft.notes,
  };
}
