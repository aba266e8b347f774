// What a report is of, and what made it.

import { h, type Child } from "../shared/dom";
import { count, date } from "../shared/format";
import type { Report } from "./types";

/** The head of a page: what kind of report, its name, a sentence, facts, and the command that made it. */
export function header(report: Report, kind: string, title: string, lead: Child[], facts: [string, Child][]): HTMLElement {
  const { machine } = report;
  const all: [string, Child][] = [...facts];
  if (machine?.cpu) all.push(["Processor", machine.cpu]);
  if (machine?.threads) all.push(["Threads", `${count(machine.threads)}${machine.cores ? ` of ${count(machine.cores)}` : ""}`]);
  if (machine?.compiler) all.push(["Compiler", machine.compiler]);
  if (machine?.os) all.push(["System", machine.os]);
  if (machine?.commit) all.push(["Grove at commit", h("code", {}, machine.commit)]);
  if (report.date) all.push(["Made", h("time", { datetime: report.date }, date(report.date))]);
  return h(
    "header",
    { class: "report-head" },
    h("p", { class: "eyebrow" }, kind),
    h("h1", {}, title),
    lead.length > 0 && h("p", { class: "lead" }, lead),
    h(
      "dl",
      { class: "facts" },
      all.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))),
    ),
    h("p", { class: "screen-only" }, saveLink(report)),
    report.command && h("pre", { class: "command", tabindex: 0, "aria-label": "The command that made this report" }, report.command),
  );
}

/** Saves what the page shows as the file that --json writes. */
function saveLink(report: Report): HTMLElement {
  const name = `${report.format ?? "grove"}.json`;
  const link = h("a", { href: "#", download: name, class: "save" }, "Save the data as JSON");
  // Made only when it is wanted: with heat maps the data are megabytes.
  link.addEventListener("click", (event) => {
    if (link.href.startsWith("blob:")) return;
    event.preventDefault();
    link.href = URL.createObjectURL(new Blob([JSON.stringify(report, null, 1)], { type: "application/json" }));
    link.click();
  });
  return link;
}

/** A part of the page with a heading that can be linked to. */
export function part(id: string, title: string, lead: Child | Child[], ...children: (Child | Child[])[]): HTMLElement {
  return h(
    "section",
    { id, "aria-labelledby": `${id}-title` },
    h("h2", { id: `${id}-title` }, title),
    lead ? h("p", { class: "lead" }, lead) : null,
    ...children,
  );
}
