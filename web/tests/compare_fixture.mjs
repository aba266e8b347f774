// Results of `grove compare` with every field there is: those that a run has not got are made up from those that it has,
// and so are heat maps, whose pixels tests must know.

/** `report` with all fields of version 1. */
export function withAllFields(report) {
  const kinds = [...new Set(report.rows.map((row) => row.rays))];
  const rows = report.rows.map((row) => ({ ...made(row), ...present(row) }));
  return {
    format: "grove-compare",
    version: 1,
    command: "grove compare builtin:sphereflake --html report.html",
    date: "2026-03-04T05:06:07Z",
    break_even: kinds.map((rays) => breakEven(rays, rows)),
    predictions: [prediction(rows)],
    matched_memory: matchedMemory(rows),
    advice: advice(rows),
    auto: { structure: "fast", reason: "triangles that do not move, and enough memory: the fast path was the quickest in 14 of 16 scenes" },
    ...present(report),
    heat_maps: heatMaps([...new Set(rows.map((row) => row.structure))]),
    rows: [
      ...rows,
      ...kinds.map((rays) => ({
        ...nothing(rows[0]),
        structure: "kdtree:max-depth=64",
        rays,
        error: "took more than the 2 GiB of --memory-limit",
      })),
    ],
  };
}

function present(object) {
  return Object.fromEntries(Object.entries(object).filter(([, value]) => value !== null && value !== undefined));
}

function nothing(row) {
  return Object.fromEntries(Object.keys(row).map((key) => [key, null]));
}

function made(row) {
  if (!row.nodes_per_ray && !row.tests_per_ray) return {};
  const mean = row.nodes_per_ray + row.tests_per_ray;
  // Rays by steps as a bell over powers of two about the mean.
  const bins = Array.from({ length: 14 }, (_, index) => (index === 0 ? 0 : 2 ** (index - 1)));
  const histogram = bins.map((from, index) => [from, Math.round(1e5 * Math.exp(-((index - 1 - Math.log2(mean)) ** 2) / 3))]);
  const work = (value) => ({ mean: value, p95: 3 * value, max: 12 * value });
  return {
    work: { nodes: work(row.nodes_per_ray), tests: work(row.tests_per_ray) },
    steps_histogram: histogram,
    duplication: row.references / 7383,
    build_seconds_one_thread: row.build_seconds && {
      median: 1.8 * row.build_seconds.median,
      min: 1.7 * row.build_seconds.min,
      max: 1.9 * row.build_seconds.max,
    },
  };
}

function breakEven(rays, rows) {
  const curves = rows
    .filter((row) => row.rays === rays && row.mrays_per_s)
    .map((row) => ({ structure: row.structure, build_seconds: row.build_seconds.median, seconds_per_ray: 1e-6 / row.mrays_per_s.median }));
  const best = [];
  let from = 0;
  let current = curves.reduce((a, b) => (b.build_seconds < a.build_seconds ? b : a));
  for (;;) {
    best.push({ from_rays: from, structure: current.structure });
    const next = curves
      .filter((curve) => curve.seconds_per_ray < current.seconds_per_ray)
      .map((curve) => ({ curve, at: (curve.build_seconds - current.build_seconds) / (current.seconds_per_ray - curve.seconds_per_ray) }))
      .sort((a, b) => a.at - b.at)[0];
    if (!next) return { rays, curves, best };
    from = next.at;
    current = next.curve;
  }
}

function prediction(rows) {
  const points = rows.filter((row) => row.mrays_per_s && row.structure !== "brute");
  return {
    title: "Equation 5 fitted to all structures",
    text: "R² 0.93: time a ray is 12.1 ns a node and 8.3 ns a test.",
    plot: {
      kind: "scatter",
      x: { label: "ns a ray, predicted", log: true },
      y: { label: "ns a ray, measured", log: true },
      series: ["primary", "diffuse"].map((name) => ({
        name,
        points: points
          .filter((row) => row.rays === name)
          .map((row) => [12.1 * row.nodes_per_ray + 8.3 * row.tests_per_ray, 1000 / row.mrays_per_s.median]),
      })),
    },
  };
}

/** Pictures of rings about a centre: element i of row j of each has a value that can be foretold. */
export function foretoldSteps(structureIndex, x, y) {
  return Math.round((structureIndex + 2) * (20 + 18 * Math.sin(Math.hypot(x - 64, y - 36) / 5)));
}

function heatMaps(structures) {
  const [width, height] = [128, 72];
  const maps = structures.slice(0, 6).map((structure, index) => {
    const steps = new Uint16Array(width * height);
    for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) steps[y * width + x] = foretoldSteps(index, x, y);
    return { structure, max: Math.max(...steps), steps: Buffer.from(steps.buffer).toString("base64") };
  });
  return { width, height, maps };
}

function matchedMemory(rows) {
  const some = rows.filter((row) => row.rays === "primary" && row.mrays_per_s).slice(0, 5);
  return {
    title: "Structures of about the same size",
    text: "For each family the leaf size whose memory is nearest to the median of all.",
    table: {
      columns: ["structure", "MiB", "Mrays/s"],
      rows: some.map((row) => [`${row.structure}:leaf-size=4`, row.bytes / 2 ** 20, row.mrays_per_s.median]),
    },
  };
}

function advice(rows) {
  const best = rows.filter((row) => row.mrays_per_s).sort((a, b) => b.mrays_per_s.median - a.mrays_per_s.median)[0];
  const why = `${best.mrays_per_s.median.toPrecision(3)} million rays a second`;
  return ["static offline", "static interactive", "moving vertices", "moving objects", "memory-bound"].map((use) => ({
    use,
    structure: best.structure,
    why,
  }));
}
