// What the 3-D view shows, under the names it uses. Generated from the backend (`make gen`).

import type { components } from "../../gen/api";

type Schemas = components["schemas"];

export type Scene = Schemas["SceneOut"];
export type Scale = Schemas["Scale"];

/** A moment of a recorded run. */
export interface Moment {
  readonly run_id: number;
  /** From the run's first tick. */
  readonly time_s: number;
}

/** How many times as large as they are the chain's deformation and the unit's travel are drawn. */
export interface Enlarged {
  readonly deformation: number;
  readonly travel: number;
}
