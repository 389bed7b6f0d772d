// Who may come in, as the server says it. Generated from the backend (`make gen`).

import type { components } from "../../gen/api";

/** Who is signed in here. */
export type Me = components["schemas"]["Me"];
