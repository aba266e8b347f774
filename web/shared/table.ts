// Tables that are sorted by a click on the head of a column, and scroll sideways under a first column that stays.

import { h, type Child } from "./dom";

export interface Column<Row> {
  title: string;
  /** What the head says when it is pointed at. */
  hint?: string;
  /** By which rows are sorted; null is last whichever way. */
  value: (row: Row) => number | string | null;
  cell: (row: Row) => Child | Child[];
  /** Whether small is good: the way of the first click. */
  ascending?: boolean;
  numeric?: boolean;
  /** Left out on paper, which is narrower. */
  minor?: boolean;
}

export interface Table<Row> {
  element: HTMLElement;
  setRows: (rows: Row[]) => void;
}

interface Settings {
  caption: string;
  /** The column that it is sorted by at first, and which way; none: as the rows come. */
  sortBy?: { column: number; descending: boolean };
}

export function sortableTable<Row>(columns: Column<Row>[], rows: Row[], settings: Settings): Table<Row> {
  let shown = rows;
  let sorted = settings.sortBy ?? null;
  const buttons = columns.map((column, index) =>
    h(
      "button",
      { type: "button", title: column.hint, onclick: () => sortBy(index) },
      column.title,
      h("span", { class: "arrow", "aria-hidden": "true" }),
    ),
  );
  const heads = columns.map((column, index) => h("th", { scope: "col", class: classOf(column, index) }, buttons[index] ?? null));
  const body = h("tbody");
  const caption = h("caption", {}, settings.caption);
  const element = h(
    "div",
    { class: "table-scroll", tabindex: 0, role: "region", "aria-label": settings.caption },
    h("table", { class: "sortable" }, caption, h("thead", {}, h("tr", {}, heads)), body),
  );

  function sortBy(index: number): void {
    const column = columns[index];
    if (!column) return;
    const first = !(column.ascending ?? !column.numeric);
    sorted = { column: index, descending: sorted?.column === index ? !sorted.descending : first };
    fill();
  }

  function fill(): void {
    const column = sorted ? columns[sorted.column] : undefined;
    const ordered = [...shown];
    if (column && sorted) {
      const sign = sorted.descending ? -1 : 1;
      ordered.sort((a, b) => compare(column.value(a), column.value(b), sign));
    }
    heads.forEach((head, index) => {
      if (sorted?.column === index) head.setAttribute("aria-sort", sorted.descending ? "descending" : "ascending");
      else head.removeAttribute("aria-sort");
    });
    body.replaceChildren(
      ...ordered.map((row) =>
        h(
          "tr",
          {},
          columns.map((one, index) =>
            index === 0 ? h("th", { scope: "row" }, one.cell(row)) : h("td", { class: classOf(one, index) }, one.cell(row)),
          ),
        ),
      ),
    );
  }

  fill();
  return {
    element,
    setRows: (next) => {
      shown = next;
      fill();
    },
  };
}

function classOf<Row>(column: Column<Row>, index: number): string | undefined {
  return [column.numeric && index > 0 && "numeric", column.minor && "screen-only"].filter(Boolean).join(" ") || undefined;
}

function compare(a: number | string | null, b: number | string | null, sign: number): number {
  if (a === null || b === null) return a === b ? 0 : a === null ? 1 : -1;
  if (typeof a === "number" && typeof b === "number") return sign * (a - b);
  return sign * String(a).localeCompare(String(b), "en", { numeric: true });
}
