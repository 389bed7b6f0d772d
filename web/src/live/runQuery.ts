// What of a run is shown, as it stands in the address. Pure.

import { chartsOf, showOf } from "../charts/series";

export const RUN_VIEWS = [
  { view: "charts", label: "Charts" },
  { view: "results", label: "Measurements" },
  { view: "response", label: "Bode" },
  { view: "analysis", label: "Analysis" },
  { view: "prediction", label: "Prediction" },
  { view: "settings", label: "Settings" },
  { view: "files", label: "Report, data" },
] as const;
export type RunViewName = (typeof RUN_VIEWS)[number]["view"];

export interface Seen {
  readonly view: RunViewName;
  readonly shown: readonly string[];
  readonly xy: boolean;
  readonly predicted: boolean;
}

export function seenOf(query: URLSearchParams): Seen {
  const asked = query.get("view");
  return {
    view: RUN_VIEWS.find(({ view }) => view === asked)?.view ?? "charts",
    shown: chartsOf(query.get("show")),
    xy: query.get("xy") === "1",
    predicted: query.get("predicted") === "1",
  };
}

/** Writes it; what is as usual needs no words. */
export function writeSeen(query: URLSearchParams, { view, shown, xy, predicted }: Seen): void {
  const words: Readonly<Record<string, string | null>> = {
    view: view === "charts" ? null : view,
    show: showOf(shown),
    xy: xy ? "1" : null,
    predicted: predicted ? "1" : null,
  };
  for (const [name, word] of Object.entries(words)) {
    if (word === null) query.delete(name);
    else query.set(name, word);
  }
}
