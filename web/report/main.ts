import "../shared/base.css";
import "../shared/tables.css";
import "./report.css";
import "./compare/compare.css";
import "./reproduce/reproduce.css";
import { readData } from "../shared/data";
import { h } from "../shared/dom";
import { comparePage } from "./compare/compare";
import { reproducePage } from "./reproduce/reproduce";
import { scalePage } from "./scale/scale";
import type { CompareReport, Report, ReproduceReport, ScaleReport } from "./types";

/** The newest version of the formats that this page knows. */
const knownVersion = 1;

function pageOf(data: unknown): HTMLElement {
  if (typeof data !== "object" || data === null) return apology("This page holds no results.");
  const report = data as Report;
  if ((report.version ?? 1) > knownVersion)
    return apology(`These results are of version ${report.version}, which this page is too old for.`);
  switch (report.format) {
    case "grove-reproduce":
      return reproducePage(report as ReproduceReport);
    case "grove-compare":
      return comparePage(report as CompareReport);
    case "grove-scale":
      return scalePage(report as ScaleReport);
    default:
      return apology(`These results are of a format that this page does not know: ${report.format ?? "none is named"}.`);
  }
}

function apology(text: string): HTMLElement {
  return h("main", {}, h("h1", {}, "Nothing to show"), h("p", {}, text));
}

document.getElementById("report")?.replaceWith(pageOf(readData()));

// What is folded would be lost on paper.
let folded: HTMLDetailsElement[] = [];
window.addEventListener("beforeprint", () => {
  folded = [...document.querySelectorAll<HTMLDetailsElement>("details.method:not([open])")];
  folded.forEach((one) => (one.open = true));
});
window.addEventListener("afterprint", () => folded.forEach((one) => (one.open = false)));

// The place that the address names is there only now.
if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
