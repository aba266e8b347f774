// The report of `grove reproduce`: the claims of the review, by its sections, each with its verdict.

import { h, type Child } from "../../shared/dom";
import { duration, plural } from "../../shared/format";
import { header } from "../header";
import { sectionElement } from "../section";
import type { Claim, ReproduceReport } from "../types";

type Verdict = Claim["verdict"];

const verdicts: Verdict[] = ["holds", "mixed", "fails"];

/** The review's sections that have claims, as it numbers them. */
const reviewSections: [string, string][] = [
  ["III.A", "Octrees"],
  ["III.B", "Kd-trees"],
  ["III.C", "Bounding volume hierarchies"],
  ["IV.A", "Parallel construction"],
  ["IV.B", "Octree-R and the cost models"],
];

export function reproducePage(report: ReproduceReport): HTMLElement {
  const groups = groupsOf(report.claims);
  const cards = new Map(report.claims.map((claim) => [claim, claimCard(claim)]));
  return h(
    "main",
    { class: "reproduce" },
    header(
      report,
      "grove reproduce",
      "The review’s claims, measured",
      [summary(report)],
      [
        ["Effort", report.quick ? "quick: small scenes" : "full"],
        ...(report.seconds === undefined ? [] : [["Experiments took", duration(report.seconds)] as [string, Child]]),
      ],
    ),
    report.complete === false &&
      h("p", { class: "warning", role: "note" }, "The run was interrupted: only these claims have been checked."),
    tally(report),
    overview(groups),
    filterBar(report, groups, cards),
    groups.map(({ id, title, claims }) =>
      h(
        "section",
        { class: "group", id, "aria-labelledby": `${id}-title` },
        h("h2", { id: `${id}-title` }, title),
        claims.map((claim) => cards.get(claim)),
      ),
    ),
    failures(report),
  );
}

interface Group {
  id: string;
  title: string;
  claims: Claim[];
}

function groupsOf(claims: Claim[]): Group[] {
  const sectionOf = (claim: Claim) => reviewSections.findIndex(([number]) => claim.source.startsWith(number));
  const groups = reviewSections.map(([number, title], index) => ({
    id: `section-${number.toLowerCase().replace(".", "-")}`,
    title: `${number} · ${title}`,
    claims: claims.filter((claim) => sectionOf(claim) === index),
  }));
  groups.push({ id: "section-more", title: "More", claims: claims.filter((claim) => sectionOf(claim) < 0) });
  return groups.filter((group) => group.claims.length > 0);
}

function summary(report: ReproduceReport): string {
  const of = (verdict: Verdict) => report.claims.filter((claim) => claim.verdict === verdict).length;
  return (
    `${plural(report.claims.length, "claim")} of a review of ray-tracing data structures, each held against an experiment: ` +
    `${of("holds")} hold as stated, ${of("mixed")} hold in part, ${of("fails")} fail.`
  );
}

/** One mark a claim, by verdict: the proportion at a glance. */
function tally(report: ReproduceReport): HTMLElement {
  return h(
    "div",
    { class: "tally", "aria-hidden": "true" },
    verdicts.flatMap((verdict) =>
      report.claims.filter((claim) => claim.verdict === verdict).map((claim) => h("span", { class: verdict, title: claim.statement })),
    ),
  );
}

/** All claims in a line each, with a way to every one. */
function overview(groups: Group[]): HTMLElement {
  return h(
    "nav",
    { class: "overview", "aria-label": "All claims" },
    groups.map(({ title, claims }) =>
      h(
        "div",
        {},
        h("p", { class: "overview-group" }, title),
        h(
          "ul",
          {},
          claims.map((claim) =>
            h("li", {}, h("span", { class: `badge ${claim.verdict}` }, claim.verdict), h("a", { href: `#${claim.id}` }, claim.statement)),
          ),
        ),
      ),
    ),
  );
}

function filterBar(report: ReproduceReport, groups: Group[], cards: Map<Claim, HTMLElement>): HTMLElement {
  const choices: (Verdict | "all")[] = ["all", ...verdicts];
  const buttons = choices.map((choice) => {
    const amount = report.claims.filter((claim) => choice === "all" || claim.verdict === choice).length;
    return h(
      "button",
      { type: "button", "data-verdict": choice, "aria-pressed": String(choice === "all"), onclick: () => choose(choice) },
      `${choice} ${amount}`,
    );
  });
  const status = h("span", { class: "visually-hidden", role: "status" });

  function choose(choice: Verdict | "all"): void {
    buttons.forEach((button) => button.setAttribute("aria-pressed", String(button.dataset["verdict"] === choice)));
    let shown = 0;
    for (const [claim, card] of cards) {
      card.hidden = choice !== "all" && claim.verdict !== choice;
      if (!card.hidden) ++shown;
    }
    for (const group of groups) {
      const element = document.getElementById(group.id);
      if (element) element.hidden = group.claims.every((claim) => cards.get(claim)?.hidden);
    }
    status.textContent = `${plural(shown, "claim")} shown`;
  }

  // A link to a claim that the filter hides shows it.
  window.addEventListener("hashchange", () => {
    const target = document.getElementById(location.hash.slice(1));
    if (target?.closest("[hidden]")) {
      choose("all");
      target.scrollIntoView();
    }
  });
  return h(
    "div",
    { class: "bar screen-only" },
    h("div", { class: "segments", role: "group", "aria-label": "Show claims by verdict" }, buttons),
    h(
      "nav",
      { class: "jump", "aria-label": "Sections of the review" },
      groups.map((group) => h("a", { href: `#${group.id}` }, group.title.split(" ")[0] ?? "")),
    ),
    status,
  );
}

function claimCard(claim: Claim): HTMLElement {
  return h(
    "article",
    { class: `card claim ${claim.verdict}`, id: claim.id, "aria-labelledby": `${claim.id}-statement` },
    h(
      "div",
      { class: "claim-head" },
      h("span", { class: `badge ${claim.verdict}` }, claim.verdict),
      h("a", { class: "claim-id", href: `#${claim.id}` }, claim.id),
      h("span", { class: "claim-source" }, claim.source, claim.seconds ? ` · ${duration(claim.seconds)}` : ""),
    ),
    h(
      "div",
      { class: "claim-text" },
      h("h3", { id: `${claim.id}-statement` }, claim.statement),
      h("p", { class: "measured" }, claim.measured),
      claim.why && h("p", { class: "why" }, h("b", {}, "Why: "), claim.why),
      h("details", { class: "method" }, h("summary", {}, "How it was measured"), h("p", {}, claim.method)),
    ),
    h(
      "div",
      { class: "figures" },
      (claim.sections ?? []).map((section) => sectionElement(section)),
    ),
  );
}

function failures(report: ReproduceReport): HTMLElement | null {
  const failed = report.failed ?? [];
  if (failed.length === 0) return null;
  return h(
    "section",
    { id: "failed", "aria-labelledby": "failed-title" },
    h("h2", { id: "failed-title" }, "Could not be checked"),
    h(
      "ul",
      {},
      failed.map(({ id, error }) => h("li", {}, h("code", {}, id), `: ${error}`)),
    ),
  );
}
