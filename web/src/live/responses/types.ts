// What the backend says of frequency responses and analyses of runs.

import type { components } from "../../gen/api";

type Schemas = components["schemas"];

export type FrequencyResponse = Schemas["ResponseOut"];
export type ResponseSeries = Schemas["ResponseSeries"];
export type LoopMargins = Schemas["LoopMargins"];
export type ResponsePoint = Schemas["ResponsePointOut"];
export type ResponseFrame = Schemas["ResponseFrame"];
export type TransferName = FrequencyResponse["transfer"];
export type Analysis = Schemas["RunAnalysis"];
