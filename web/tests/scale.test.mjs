// The page of `grove compare --scale`, and pages of results that are none.

import assert from "node:assert/strict";
import { after, describe, test } from "node:test";
import { chartCounts, openPage, overflow, pageWith, runGrove, screenshot, scrollThrough, startBrowser } from "./browser.mjs";
import { scaleReport } from "./scale_fixture.mjs";

const browser = await startBrowser();
after(() => browser?.close());

describe("growth", { skip: !browser }, () => {
  test("is a page that the command writes", async () => {
    const html = runGrove(
      ...["compare", "builtin:spheres", "--scale", "--sizes", "200,400,800", "--structures", "bvh;octree", "--count", "200"],
      ...["--rounds", "1", "--quiet", "--html", "scale.html"],
    );
    const { page, problems, close } = await openPage(browser, html);
    await scrollThrough(page);
    assert.equal(await page.locator("#fits tbody tr").count(), 2);
    assert.equal(await page.locator("#figures tbody tr").count(), 6);
    const { all, drawn } = await chartCounts(page);
    assert.deepEqual([all, drawn], [4, 4]);
    assert.deepEqual(problems, []);
    await close();
  });

  test("shows exponents, charts and failures", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "Growth", scaleReport()));
    await scrollThrough(page);
    for (const part of ["fits", "build", "memory", "steps", "speed", "figures", "failures"]) assert.ok(await page.$(`#${part}`), part);
    assert.match(await page.textContent("#fits tbody tr:has-text('kdtree')"), /n1\.09/);
    assert.equal(await page.locator("#failures li").count(), 2);
    const { all, drawn } = await chartCounts(page);
    assert.deepEqual([all, drawn], [4, 4]);
    await screenshot(page, "scale-desktop");
    assert.deepEqual(problems, []);
    await close();
  });

  test("fits a phone", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "Growth", scaleReport()), {
      viewport: { width: 390, height: 844 },
      isMobile: true,
    });
    await scrollThrough(page);
    assert.equal(await overflow(page), 0);
    await screenshot(page, "scale-phone");
    assert.deepEqual(problems, []);
    await close();
  });
});

describe("a page", { skip: !browser }, () => {
  for (const [what, data, text] of [
    ["without results", "nothing", /holds no results/],
    ["of an unknown format", { format: "grove-other", version: 1 }, /grove-other/],
    ["of a newer version", { format: "grove-compare", version: 2, rows: [] }, /version 2/],
    ["of a comparison without rows", { format: "grove-compare", version: 1, scene: "empty", rows: [] }, /empty/],
  ]) {
    test(`${what} says so`, async () => {
      const { page, problems, close } = await openPage(browser, pageWith("report", "A title", data));
      assert.match(await page.textContent("body"), text);
      assert.deepEqual(problems, []);
      await close();
    });
  }
});
