// Requests to /api/v1/scene.

import { post, request } from "../api";
import type { Enlarged, Moment, Scene } from "./types";

export const getScene = (): Promise<Scene> => request("scene");

/** What a view of this page's own shows; the rig as it is now without a moment. */
export const pointScene = (view: string, moment: Moment | null, enlarged: Enlarged): Promise<Scene> =>
  request("scene/cursor", post({ view, ...moment, ...enlarged }));
