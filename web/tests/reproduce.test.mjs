// The page of `grove reproduce`.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { chartCounts, dataOf, openPage, overflow, pageWith, runGrove, screenshot, scrollThrough, startBrowser } from "./browser.mjs";

const browser = await startBrowser();
after(() => browser?.close());

/** The claims of `report` with those of every verdict and section among them, and one that could not be checked. */
function varied(report) {
  const [claim] = report.claims;
  const others = [
    ["made-up-fails", "III.B.2", "fails"],
    ["made-up-mixed", "IV.A.1", "mixed"],
    ["made-up-holds", "equation 5", "holds"],
  ].map(([id, source, verdict]) => ({ ...claim, id, source, verdict, measured: "<b>No markup</b> & no script </script>" }));
  return { ...report, complete: false, claims: [...report.claims, ...others], failed: [{ id: "made-up", error: "not enough memory" }] };
}

describe("grove reproduce --html", { skip: !browser }, () => {
  let html;
  let report;
  const ids = ["octree-deep-and-empty", "octree-ray-generator"];
  before(() => {
    html = runGrove("reproduce", "--quick", "--only", ids.join(","), "--quiet", "--html", "reproduce.html");
    report = varied(dataOf(html));
  });

  test("writes a page with each claim and its figures", async () => {
    const { page, problems, close } = await openPage(browser, html);
    assert.deepEqual(await page.$$eval(".claim", (cards) => cards.map((card) => card.id).sort()), ids);
    await scrollThrough(page);
    const { all, drawn } = await chartCounts(page);
    assert.ok(all >= 2);
    assert.equal(drawn, all);
    for (const claim of dataOf(html).claims) {
      const text = await page.textContent(`#${claim.id}`);
      for (const part of [claim.statement, claim.measured, claim.method, claim.verdict]) assert.ok(text.includes(part), part);
    }
    assert.deepEqual((await page.$$eval(".overview a", (links) => links.map((link) => link.hash.slice(1)))).sort(), ids);
    await screenshot(page, "reproduce-desktop");
    assert.deepEqual(problems, []);
    await close();
  });

  test("groups claims by the review's sections, and says what is missing", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "Claims", report));
    const titles = await page.$$eval("h2", (heads) => heads.map((head) => head.textContent));
    assert.deepEqual(titles, ["III.A · Octrees", "III.B · Kd-trees", "IV.A · Parallel construction", "More", "Could not be checked"]);
    assert.match(await page.textContent(".warning"), /interrupted/);
    assert.match(await page.textContent("#failed"), /made-up: not enough memory/);
    assert.match(await page.textContent("#made-up-fails .measured"), /<b>No markup<\/b>/);
    assert.deepEqual(problems, []);
    await close();
  });

  test("filters by verdict, and shows what a link names all the same", async () => {
    const { page, close } = await openPage(browser, pageWith("report", "Claims", report));
    const visible = () => page.$$eval(".claim", (cards) => cards.filter((card) => card.checkVisibility()).map((card) => card.id));
    assert.equal((await visible()).length, 5);
    await page.click('[data-verdict="fails"]');
    const failing = report.claims.filter((claim) => claim.verdict === "fails").map((claim) => claim.id);
    assert.deepEqual((await visible()).sort(), failing.sort());
    assert.equal(await page.isVisible("#section-iv-a"), false, "a section without claims to show");
    assert.equal(await page.getAttribute('[data-verdict="fails"]', "aria-pressed"), "true");
    await page.evaluate(() => (location.hash = "#made-up-mixed"));
    await page.waitForFunction(() => document.getElementById("made-up-mixed").checkVisibility());
    await page.click('[data-verdict="all"]');
    assert.equal((await visible()).length, 5);
    await close();
  });

  test("sorts the tables of figures, which are folded away", async () => {
    const { page, close } = await openPage(browser, html);
    const card = page.locator("#octree-deep-and-empty");
    await card.locator(".figures summary").click();
    const heads = await card.locator("thead th").allTextContents();
    const depth = heads.indexOf("depth");
    assert.notEqual(depth, -1, `no column depth among ${heads}`);
    const values = async () => (await card.locator(`tbody tr > :nth-child(${depth + 1})`).allTextContents()).map(Number);
    await card.locator("thead th").nth(depth).locator("button").click();
    const once = await values();
    assert.deepEqual(
      once,
      [...once].sort((a, b) => b - a),
    );
    assert.ok(new Set(once).size > 1);
    await card.locator("thead th").nth(depth).locator("button").click();
    assert.deepEqual(await values(), [...once].reverse());
    await close();
  });

  test("gives its data back", async () => {
    const { page, close } = await openPage(browser, html);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(".save")]);
    assert.equal(download.suggestedFilename(), "grove-reproduce.json");
    assert.deepEqual(JSON.parse(readFileSync(await download.path(), "utf8")), dataOf(html));
    await close();
  });

  test("fits a phone", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "Claims", report), {
      viewport: { width: 390, height: 844 },
      isMobile: true,
      hasTouch: true,
    });
    await scrollThrough(page);
    assert.equal(await overflow(page), 0);
    await page.locator(".figures details summary").first().click();
    assert.equal(await overflow(page), 0, "with an open table");
    await screenshot(page, "reproduce-phone");
    assert.deepEqual(problems, []);
    await close();
  });

  test("is all there on paper", async () => {
    const { page, close } = await openPage(browser, html, { colorScheme: "dark" });
    await page.emulateMedia({ media: "print" });
    await page.waitForFunction(() => [...document.querySelectorAll(".chart")].every((chart) => chart.querySelector("svg path")));
    assert.equal(await page.isVisible(".bar"), false);
    assert.equal(await overflow(page), 0);
    await close();
  });
});
