// All figures of the chosen kind of rays.

import { h, type Child } from "../../shared/dom";
import { bytes, count, duration, missing, number } from "../../shared/format";
import { sortableTable, type Column } from "../../shared/table";
import type { Row, Spread } from "../types";
import { structureName } from "./controls";
import type { View } from "./view";

export function rowsTable(view: View): HTMLElement {
  let fastest = 0;
  const measure = () => (fastest = Math.max(0, ...view.rows().map((row) => row.mrays_per_s?.median ?? 0)));
  measure();
  // Columns without a single figure are left out.
  const columns = allColumns(() => fastest).filter((column) => view.report.rows.some((row) => column.value(row) !== null));
  const table = sortableTable(columns, view.rows(), {
    caption: "Structures and their figures",
    sortBy: {
      column: Math.max(
        0,
        columns.findIndex((column) => column.title === "Mrays/s"),
      ),
      descending: true,
    },
  });
  table.element.classList.add("tall", "wide-names");
  view.onChange(() => {
    measure();
    table.setRows(view.rows());
  });
  return table.element;
}

function allColumns(fastest: () => number): Column<Row>[] {
  return [
    {
      title: "Structure",
      ascending: true,
      value: (row) => row.structure,
      cell: (row) => [structureName(row.structure), row.error ? h("span", { class: "badge fails", title: row.error }, "failed") : null],
    },
    {
      title: "Mrays/s",
      hint: "Millions of rays a second: median over the rounds, least and most",
      numeric: true,
      value: (row) => row.mrays_per_s?.median ?? null,
      cell: (row) => speedCell(row.mrays_per_s, fastest()),
    },
    {
      title: "×\u00a0first",
      hint: "Speed against the first structure, round by round: the median",
      numeric: true,
      value: (row) => row.ratio_to_first?.median ?? null,
      cell: (row) => number(row.ratio_to_first?.median),
    },
    figure("Nodes/ray", "Nodes visited, a ray", (row) => row.nodes_per_ray, number),
    minor(figure("95\u00a0%", "Nodes visited by the ray that 95 of 100 do not exceed", (row) => row.work?.nodes?.p95, number)),
    figure("Tests/ray", "Primitives tested, a ray", (row) => row.tests_per_ray, number),
    minor(figure("95\u00a0%", "Primitives tested by the ray that 95 of 100 do not exceed", (row) => row.work?.tests?.p95, number)),
    figure("Build", "Wall clock, all threads: the median", (row) => row.build_seconds?.median, duration),
    figure("Build, 1\u00a0thread", "Wall clock, one thread: the median", (row) => row.build_seconds_one_thread?.median, duration),
    figure(
      "Update",
      "Following moved vertices: by a refit, or by building anew where there is none",
      (row) => row.update?.seconds,
      duration,
    ),
    figure("Memory", "Of the structure, without the geometry", (row) => row.bytes, bytes),
    minor(figure("References", "Primitives as leaves hold them", (row) => row.references, count)),
    figure("Duplication", "References a primitive", (row) => row.duplication, number),
    minor(figure("Nodes", "", (row) => row.nodes, count)),
    minor(figure("Leaves", "", (row) => row.leaves, count)),
    minor(figure("Depth", "", (row) => row.depth, count)),
    figure("Cost", "Surface-area cost of a ray that meets the root", (row) => row.expected_cost, number),
    minor(figure("EPO", "End-point overlap: the time a ray spends in vain round its end", (row) => row.end_point_overlap, number)),
    minor(figure("Overlap", "Chance that a ray must enter both children", (row) => row.sibling_overlap, number)),
    minor(figure("Wrong hits", "Rays whose hit is not, bit for bit, the reference's", (row) => row.mismatches, count)),
  ];
}

function minor(column: Column<Row>): Column<Row> {
  return { ...column, minor: true };
}

function figure(
  title: string,
  hint: string,
  value: (row: Row) => number | null | undefined,
  format: (value: number | null | undefined) => string,
): Column<Row> {
  const column: Column<Row> = {
    title,
    numeric: true,
    ascending: true,
    value: (row) => value(row) ?? null,
    cell: (row) => format(value(row)),
  };
  return hint ? { ...column, hint } : column;
}

/** The median over a bar that says how near to the fastest it is, then the spread. */
function speedCell(spread: Spread | null | undefined, fastest: number): Child {
  if (!spread) return missing;
  const share = fastest > 0 ? (100 * spread.median) / fastest : 0;
  return h(
    "span",
    { class: "speed", style: `--share: ${share.toFixed(1)}%` },
    h("b", {}, number(spread.median)),
    h("span", { class: "spread" }, ` ${number(spread.min)}–${number(spread.max)}`),
  );
}
