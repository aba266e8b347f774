// One figure of a report: heading, text, plot and table.

import { h, slug, type Child } from "../shared/dom";
import { count, missing, number, plural } from "../shared/format";
import { sortableTable, type Column } from "../shared/table";
import { plotChart } from "./plot";
import type { Cell, Section } from "./types";

type TableData = NonNullable<Section["table"]>;

/** Shorter tables stand open. */
const shortTable = 6;

export function sectionElement(section: Section, settings: { heading?: boolean } = {}): HTMLElement {
  const parts: Child[] = [];
  if (settings.heading ?? true) parts.push(h("figcaption", {}, section.title));
  if (section.text) parts.push(h("p", { class: "lead" }, section.text));
  if (section.plot && section.plot.series.length > 0) parts.push(plotChart(section.plot, section.title).element);
  if (section.table) parts.push(tableElement(section.table, section.title, Boolean(section.plot)));
  return h("figure", { class: "section", id: `figure-${slug(section.title)}` }, parts);
}

function tableElement(table: TableData, title: string, folds: boolean): HTMLElement {
  const element = dataTable(table, title);
  if (table.rows.length > 14) element.classList.add("tall");
  if (!folds || table.rows.length <= shortTable) return element;
  return h("details", { class: "figures" }, h("summary", {}, `Table of ${plural(table.rows.length, "row")}`), element);
}

/** A table as it came, to be sorted by any column. */
export function dataTable(table: TableData, title: string): HTMLElement {
  const columns = table.columns.map((name, index): Column<Cell[]> => {
    const numeric = table.rows.some((row) => typeof row[index] === "number");
    const wordy = !numeric && table.rows.some((row) => String(row[index] ?? "").length > 48);
    return {
      title: name,
      numeric,
      value: (row) => row[index] ?? null,
      cell: (row) => {
        const value = row[index];
        if (value === null || value === undefined || value === "") return missing;
        if (typeof value === "number") return Number.isInteger(value) ? count(value) : number(value);
        return wordy ? h("span", { class: "words" }, value) : value;
      },
    };
  });
  return sortableTable(columns, table.rows, { caption: title }).element;
}
