// The page of `grove compare`: as the command writes it, and with every field that results can have.

import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { chartCounts, dataOf, openPage, overflow, pageWith, runGrove, screenshot, scrollThrough, startBrowser } from "./browser.mjs";
import { foretoldSteps, withAllFields } from "./compare_fixture.mjs";

const browser = await startBrowser();
after(() => browser?.close());

/** The texts of a column of the table of all figures, from the top. */
function column(page, index) {
  return page.$$eval(`#figures tbody tr > :nth-child(${index + 1})`, (cells) => cells.map((cell) => cell.textContent));
}

async function columnOf(page, title) {
  const titles = await page.$$eval("#figures thead th", (heads) => heads.map((head) => head.textContent));
  const index = titles.indexOf(title);
  assert.notEqual(index, -1, `no column ${title} among ${titles}`);
  return index;
}

describe("grove compare --html", { skip: !browser }, () => {
  let html;
  let report;
  before(() => {
    html = runGrove(
      ...["compare", "builtin:cornell", "--structures", "bvh;bvh:split=lbvh;kdtree;octree;fast;brute"],
      ...["--rays", "primary,random", "--count", "2000", "--rounds", "2", "--quiet", "--html", "compare.html"],
    );
    report = withAllFields(dataOf(html));
  });

  test("writes a page that shows every row", async () => {
    const { page, problems, close } = await openPage(browser, html);
    await scrollThrough(page);
    assert.match(await page.title(), /builtin:cornell/);
    assert.equal(await page.textContent("h1"), "builtin:cornell");
    assert.equal((await column(page, 0)).length, 6);
    assert.equal(await page.locator(".heat-picture").count(), 6);
    for (const part of ["advice", "steps", "break-even", "predictions"]) assert.ok(await page.$(`#${part}`), part);
    const { all, drawn } = await chartCounts(page);
    assert.ok(all >= 3);
    assert.equal(drawn, all);
    assert.deepEqual(problems, []);
    await close();
  });

  test("shows every part of the results", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "All", report));
    const parts = [
      "advice",
      "glance",
      "failures",
      "speed",
      "figures",
      "memory",
      "work",
      "steps",
      "break-even",
      "heat-maps",
      "predictions",
      "matched-memory",
    ];
    for (const part of parts) assert.ok(await page.$(`#${part}`), part);
    for (const target of await page.$$eval(".jump a", (links) => links.map((link) => link.hash))) assert.ok(await page.$(target), target);
    assert.match(await page.textContent("#failures"), /kdtree:max-depth=64.*took more than the 2 GiB/s);
    assert.equal(await page.locator("#advice .card").count(), 5);
    await scrollThrough(page);
    const { all, drawn } = await chartCounts(page);
    assert.equal(drawn, all);
    await screenshot(page, "compare-desktop");
    assert.deepEqual(problems, []);
    await close();
  });

  test("draws charts only when they come into view", async () => {
    const { page, close } = await openPage(browser, pageWith("report", "All", report));
    const { all, drawn } = await chartCounts(page);
    assert.ok(drawn < all, `${drawn} of ${all} charts are drawn`);
    await close();
  });

  test("sorts the table by a click and by the keyboard", async () => {
    const { page, close } = await openPage(browser, pageWith("report", "All", report));
    const memory = await columnOf(page, "Memory");
    const sizes = new Map(report.rows.map((row) => [row.structure, row.bytes]));
    const shown = async () =>
      (await column(page, 0)).map((name) => sizes.get(name.replace(/failed$/, "")) ?? null).filter((size) => size !== null);
    const button = page.locator("#figures thead th").nth(memory).locator("button");
    await button.click();
    const ascending = await shown();
    assert.ok(ascending.length >= 5);
    assert.deepEqual(
      ascending,
      [...ascending].sort((a, b) => a - b),
    );
    assert.equal(await page.locator("#figures thead th").nth(memory).getAttribute("aria-sort"), "ascending");
    await button.press("Enter");
    assert.deepEqual(await shown(), [...ascending].reverse());
    assert.equal(await page.locator("#figures thead th").nth(memory).getAttribute("aria-sort"), "descending");
    assert.match((await column(page, 0)).at(-1), /failed/, "rows without a figure are last whichever way");
    await close();
  });

  test("follows the choice of rays and of families", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "All", report));
    const nodes = await columnOf(page, "Nodes/ray");
    await scrollThrough(page);
    const before = { cells: await column(page, nodes), bars: await page.locator("#speed svg").innerHTML() };
    await page.click('[data-rays="random"]');
    assert.notDeepEqual(await column(page, nodes), before.cells);
    assert.notEqual(await page.locator("#speed svg").innerHTML(), before.bars);
    assert.match(await page.textContent("#speed .lead"), /random/);
    await page.click('[data-family="bvh"]');
    assert.deepEqual(
      (await column(page, 0)).filter((name) => name.startsWith("bvh")),
      [],
    );
    assert.doesNotMatch(await page.locator("#speed svg").innerHTML(), /bvh/);
    await page.click('[data-family="bvh"]');
    assert.equal((await column(page, 0)).filter((name) => name.startsWith("bvh")).length, 2);
    assert.deepEqual(problems, []);
    await close();
  });

  test("moves the scale of all heat maps with one slider", async () => {
    const { page, close } = await openPage(browser, pageWith("report", "All", report));
    const brightness = () =>
      page.$$eval(".heat-picture:not([hidden]) canvas", (canvases) =>
        canvases.map((canvas) =>
          canvas
            .getContext("2d")
            .getImageData(0, 0, canvas.width, canvas.height)
            .data.reduce((sum, value) => sum + value, 0),
        ),
      );
    const setSlider = (value) =>
      page.$eval(
        "#heat-maximum",
        (slider, position) => {
          slider.value = position;
          slider.dispatchEvent(new Event("input"));
        },
        value,
      );
    await setSlider(200);
    const [dark, darkText] = [await brightness(), await page.textContent("#heat-top")];
    await setSlider(110);
    const [bright, brightText] = [await brightness(), await page.textContent("#heat-top")];
    assert.equal(dark.length, 6);
    dark.forEach((sum, index) => assert.ok(bright[index] > sum, `picture ${index} did not get brighter`));
    assert.notEqual(darkText, brightText);
    await page.focus("#heat-maximum");
    await page.keyboard.press("ArrowLeft");
    assert.notEqual(await page.textContent("#heat-top"), brightText);
    await close();
  });

  test("reads the same pixel of all heat maps", async () => {
    const { page, close } = await openPage(browser, pageWith("report", "All", report));
    const values = () => page.$$eval(".heat-picture:not([hidden]) .lead", (texts) => texts.map((text) => text.textContent));
    (await values()).forEach((text) => assert.match(text, /on average/));
    // The middle of the picture, which the arrow keys start from.
    await page.locator(".heat-picture canvas").first().focus();
    await page.keyboard.press("ArrowRight");
    assert.deepEqual(
      await values(),
      [0, 1, 2, 3, 4, 5].map((index) => `${foretoldSteps(index, 65, 36)} steps here`),
    );
    const canvas = page.locator(".heat-picture canvas").nth(1);
    const { width, height } = await canvas.boundingBox();
    await canvas.hover({ position: { x: (width * 20.5) / 128, y: (height * 10.5) / 72 } });
    assert.deepEqual(
      await values(),
      [0, 1, 2, 3, 4, 5].map((index) => `${foretoldSteps(index, 20, 10)} steps here`),
    );
    await close();
  });

  test("shows times against the best, on request", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "All", report));
    await page.locator("#break-even .chart").scrollIntoViewIfNeeded();
    await page.waitForSelector("#break-even svg");
    const before = await page.locator("#break-even svg").innerHTML();
    await page.click("#break-even button:has-text('against the best')");
    assert.notEqual(await page.locator("#break-even svg").innerHTML(), before);
    assert.equal(await page.locator("#break-even .best-from li").count(), report.break_even[0].best.length);
    assert.deepEqual(problems, []);
    await close();
  });

  test("fits a phone, in the dark", async () => {
    const phone = { viewport: { width: 390, height: 844 }, colorScheme: "dark", hasTouch: true, isMobile: true };
    const { page, problems, close } = await openPage(browser, pageWith("report", "All", report), phone);
    await scrollThrough(page);
    assert.equal(await overflow(page), 0);
    const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.match(background, /rgb\((\d|[1-5]\d), (\d|[1-5]\d), (\d|[1-5]\d)\)/, "a dark page");
    await screenshot(page, "compare-phone-dark");
    assert.deepEqual(problems, []);
    await close();
  });

  test("is all there on paper, in the colours of paper", async () => {
    const { page, problems, close } = await openPage(browser, pageWith("report", "All", report), { colorScheme: "dark" });
    await page.emulateMedia({ media: "print" });
    await page.waitForFunction(() => [...document.querySelectorAll(".chart")].every((chart) => chart.querySelector("svg path")));
    assert.equal(await page.isVisible(".controls"), false);
    const texts = await page.$$eval(".chart svg text", (all) => [
      ...new Set(all.map((text) => text.getAttribute("fill") ?? text.style.fill)),
    ]);
    assert.deepEqual(texts.sort(), ["#000", "#444"], "black and grey, not the light ink of dark pages");
    assert.ok((await page.pdf({ format: "A4" })).length > 20000);
    assert.deepEqual(problems, []);
    await close();
  });
});
