// The JSON that the page is given: format "grove-inspect", version 1. docs/inspect-view.md describes it.

export type Triple = [number, number, number];

export interface PayloadBox {
  lower: Triple;
  upper: Triple;
}

export interface PayloadStructure {
  structure: string;
  figures: Record<string, unknown>;
  has_top_level: boolean;
  objects_shown: boolean;
  bounds: PayloadBox;
  nodes: {
    count: number;
    total: number;
    complete_depth: number;
    parents: string;
    boxes: string;
    kinds: string;
    children: string;
    references: string;
    visits: string;
    tests: string;
    planes: string;
  };
  sampled_rays: number;
  picture: { width: number; height: number; steps: string };
  traces: string;
}

export interface Payload {
  format: "grove-inspect";
  version: 1;
  machine: { cpu: string; cores: number; threads: number; compiler: string; commit: string; os: string };
  command: string;
  date: string;
  scene: string;
  primitives: number;
  bounds: PayloadBox;
  camera: { eye: Triple; forward: Triple; up: Triple; vertical_field_of_view: number };
  triangles: { total: number; shown: number; grid: number; one_in: number; vertices: string; indices: string };
  picture: { width: number; height: number; shades: string };
  rays: { stride: number; columns: number; rows: number; lines: string; distances: string };
  tested: { count: number; kinds: string; ids: string; instances: string; shapes: string };
  structures: PayloadStructure[];
}

export function isPayload(data: unknown): data is Payload {
  if (typeof data !== "object" || data === null) return false;
  const { format, version } = data as { format?: unknown; version?: unknown };
  return format === "grove-inspect" && version === 1;
}
