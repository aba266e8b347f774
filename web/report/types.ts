// Version 1 of the results that the page shows; docs/reports.md describes them. A field that is optional here need not be there, and
// null stands where a figure is missing.

export interface Machine {
  cpu?: string;
  cores?: number;
  threads?: number;
  compiler?: string;
  commit?: string;
  os?: string;
}

export interface Report {
  format?: string;
  version?: number;
  machine?: Machine;
  command?: string;
  date?: string;
}

export interface Axis {
  label: string;
  log?: boolean;
  categories?: string[];
}

/** x, y, and where there is a spread its least and most. */
export type Point = [number, number | null] | [number, number | null, number | null, number | null];

export interface Series {
  name: string;
  points: Point[];
}

export interface Plot {
  kind: "line" | "scatter" | "bar";
  x: Axis;
  y: Axis;
  series: Series[];
}

export type Cell = string | number | null;

export interface Section {
  title: string;
  text?: string;
  table?: { columns: string[]; rows: Cell[][] };
  plot?: Plot;
}

export interface Spread {
  median: number;
  min: number;
  max: number;
}

export interface Work {
  mean: number;
  p95: number;
  max: number;
}

export interface Row {
  structure: string;
  rays: string;
  ray_count?: number;
  mrays_per_s?: Spread | null;
  ratio_to_first?: Spread | null;
  nodes_per_ray?: number | null;
  tests_per_ray?: number | null;
  build_seconds?: Spread | null;
  build_seconds_one_thread?: Spread | null;
  /** Following moved vertices: by a refit, or by building anew where there is none. */
  update?: { method: string; seconds: number } | null;
  bytes?: number | null;
  expected_cost?: number | null;
  end_point_overlap?: number | null;
  sibling_overlap?: number | null;
  references?: number | null;
  duplication?: number | null;
  nodes?: number | null;
  leaves?: number | null;
  depth?: number | null;
  mismatches?: number | null;
  work?: { nodes?: Work; tests?: Work } | null;
  /** Steps from which a bin begins, and rays in it. */
  steps_histogram?: [number, number][] | null;
  error?: string;
}

export interface BreakEven {
  rays: string;
  curves: { structure: string; build_seconds: number; seconds_per_ray: number }[];
  best: { from_rays: number; structure: string }[];
}

export interface HeatMaps {
  width: number;
  height: number;
  /** Steps of each pixel as little-endian 16-bit numbers in base64, row by row from the top. */
  maps: { structure: string; max: number; steps: string }[];
}

export interface CompareReport extends Report {
  scene: string;
  primitives?: number;
  ray_count?: number;
  rounds?: number;
  complete?: boolean;
  rows: Row[];
  notes?: string[];
  break_even?: BreakEven[];
  predictions?: Section[];
  heat_maps?: HeatMaps | null;
  matched_memory?: Section | null;
  advice?: { use: string; structure: string; why: string }[];
  auto?: { structure: string; reason: string } | null;
}

export interface Claim {
  id: string;
  statement: string;
  source: string;
  method: string;
  measured: string;
  /** What explains it, by counts. */
  why?: string;
  verdict: "holds" | "fails" | "mixed";
  seconds?: number;
  sections?: Section[];
}

export interface ReproduceReport extends Report {
  quick?: boolean;
  seconds?: number;
  complete?: boolean;
  claims: Claim[];
  failed?: { id: string; error: string }[];
}

export interface Fit {
  exponent: number;
  /** The figure at one primitive; zero where nothing could be fitted. */
  factor?: number;
  r_squared: number;
}

export interface ScaleRow {
  structure: string;
  primitives: number;
  build_seconds?: number | null;
  bytes?: number | null;
  steps_per_ray?: number | null;
  nodes_per_ray?: number | null;
  tests_per_ray?: number | null;
  mrays_per_s?: number | Spread | null;
  error?: string;
}

export interface ScaleReport extends Report {
  scene: string;
  sizes?: number[];
  rays?: string;
  ray_count?: number;
  complete?: boolean;
  rows: ScaleRow[];
  fits?: { structure: string; build?: Fit | null; memory?: Fit | null; steps?: Fit | null }[];
  sections?: Section[];
  notes?: string[];
}
