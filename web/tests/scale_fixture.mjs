// Results as `grove compare --scale` has them, of structures that grow by power laws.

const laws = [
  { structure: "brute", build: null, memory: null, steps: [1, 1] },
  { structure: "octree", build: [2.1e-7, 1.12], memory: [31, 1.04], steps: [9, 0.19] },
  { structure: "kdtree", build: [9e-7, 1.09], memory: [44, 1.01], steps: [8, 0.15] },
  { structure: "bvh", build: [1.1e-7, 1.03], memory: [19, 1], steps: [7, 0.13] },
  { structure: "bvh:split=lbvh", build: [2e-8, 1], memory: [19, 1], steps: [9, 0.15] },
  { structure: "fast", build: [1.6e-7, 1.02], memory: [34, 1], steps: [4, 0.12] },
];
const sizes = [1e3, 1e4, 1e5, 1e6, 1e7];

export function scaleReport() {
  const at = (law, size) => law && law[0] * size ** law[1];
  const fit = (law) => law && { exponent: law[1], r_squared: 0.998 };
  const rows = laws.flatMap(({ structure, build, memory, steps }) =>
    sizes.map((primitives) =>
      structure === "brute" && primitives > 1e5
        ? {
            structure,
            primitives,
            build_seconds: null,
            bytes: null,
            steps_per_ray: null,
            mrays_per_s: null,
            error: "took more than the 60 s of --time-limit",
          }
        : {
            structure,
            primitives,
            build_seconds: at(build, primitives),
            bytes: at(memory, primitives),
            steps_per_ray: at(steps, primitives),
            mrays_per_s: 120 / at(steps, primitives),
          },
    ),
  );
  return {
    format: "grove-scale",
    version: 1,
    machine: { cpu: "A processor", cores: 2, threads: 2, compiler: "GCC 12.2.0", commit: "0123456789ab", os: "Linux" },
    command: "grove compare builtin:spheres --scale --html scale.html",
    date: "2026-03-04T05:06:07Z",
    scene: "builtin:spheres",
    sizes,
    rows,
    fits: laws.map(({ structure, build, memory, steps }) => ({ structure, build: fit(build), memory: fit(memory), steps: fit(steps) })),
    sections: [],
  };
}
