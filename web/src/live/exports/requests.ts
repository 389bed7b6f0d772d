// Requests about exports and reports of a run.

import type { components } from "../../gen/api";
import { post, request } from "../api";

type Schemas = components["schemas"];
export type Export = Schemas["ExportOut"];
export type ExportWish = Partial<Schemas["ExportAsked"]> & Pick<Schemas["ExportAsked"], "format">;
export type FormatName = Schemas["FormatName"];
export type Job = Schemas["JobOut"];

export const FORMATS: readonly { readonly format: FormatName; readonly label: string; readonly says: string }[] = [
  { format: "parquet", label: "Parquet", says: "As recorded: for Python, MATLAB and databases; the smallest" },
  { format: "csv", label: "CSV", says: "Text with units in the header: large, and slow to make and to read" },
  { format: "mat", label: "MATLAB", says: "A variable a channel, units and settings beside them" },
  { format: "tdms", label: "TDMS", says: "For LabVIEW and DIAdem" },
  { format: "h5", label: "HDF5", says: "Compressed; for MATLAB, Python and others" },
];

export const listExports = (run: number): Promise<readonly Export[]> => request(`runs/${run}/exports`);
export const startExport = (run: number, wish: ExportWish): Promise<Export> =>
  request(`runs/${run}/exports`, post(wish));
export const removeExport = (run: number, id: string): Promise<unknown> =>
  request(`runs/${run}/exports/${id}`, { method: "DELETE" });
export const exportFileUrl = (run: number, id: string): string => `/api/v1/runs/${run}/exports/${id}/file`;

export type Extent = "brief" | "full";
export type ReportFormat = "pdf" | "html";
export const reportUrl = (run: number, format: ReportFormat, extent: Extent): string =>
  `/api/v1/runs/${run}/report.${format}?extent=${extent}`;
export const reportProgress = (run: number, format: ReportFormat, extent: Extent): Promise<Job> =>
  request(`runs/${run}/report?extent=${extent}&format=${format}`);
