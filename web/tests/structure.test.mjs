// The page of `grove inspect --html`, made by the command itself.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { groveCommand, openPage, overflow, pageWith, screenshot, startBrowser, temporaryFolder } from "./browser.mjs";

const browser = await startBrowser();
after(() => browser?.close());

const folder = temporaryFolder();
const made = new Map();

/** What goes wrong in a page, but for what Chromium says of pictures read back from a graphics card that it plays itself. */
const wrong = (problems) => problems.filter((problem) => !/GL Driver Message .*ReadPixels/.test(problem));

/** The page that the command writes; each is made once. */
function pageOf(scene, structures) {
  const key = `${scene} ${structures}`;
  if (!made.has(key)) {
    const file = join(folder, `${made.size}.html`);
    execFileSync(groveCommand, ["inspect", scene, "--structure", structures, "--html", file, "--quiet"], { stdio: ["ignore", "ignore", "inherit"] });
    made.set(key, readFileSync(file, "utf8"));
  }
  return made.get(key);
}

// Small, as tests draw without a graphics card.
const three = () => pageOf("builtin:rings?triangles=4000", "bvh;kdtree;octree:walk=neighbour");

/** The colours of a canvas, as a text that differs when the picture does. Drawn once more, as what a browser has shown may be gone. */
function pictureOf(page, index = 0) {
  return page.locator(".pane").nth(index).screenshot().then((png) => png.toString("base64"));
}

async function pickRay(page, x = 0.5, y = 0.6) {
  const canvas = page.locator(".picture canvas");
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  await canvas.click({ position: { x: box.width * x, y: box.height * y } });
}

test("a page without data says so", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, pageWith("structure", "Nothing", "nothing"));
  assert.match(await page.textContent("#view"), /nothing to show/);
  assert.deepEqual(wrong(problems), []);
  await close();
});

test("structures stand side by side and change with levels and colours", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, three());
  assert.equal(await page.locator(".pane canvas").count(), 3);
  assert.deepEqual(await page.locator(".pane h2").allTextContents(), ["bvh", "kdtree", "octree:walk=neighbour"]);
  const first = await pictureOf(page);
  await page.getByLabel("Last level shown").fill("12");
  assert.match(await page.textContent("#levels"), /to 12/);
  const second = await pictureOf(page);
  assert.notEqual(first, second, "other levels look the same");
  await page.getByLabel("Colour by").selectOption("area");
  const third = await pictureOf(page);
  assert.notEqual(second, third, "other colours look the same");
  await page.getByLabel("Nodes as").selectOption("planes");
  await screenshot(page, "structure-planes");
  // The first handle cannot pass the last.
  await page.getByLabel("First level shown").fill("14");
  assert.equal(await page.textContent("#levels"), "14");
  assert.deepEqual(wrong(problems), []);
  await close();
});

test("a ray is stepped forwards and backwards through all structures", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, three());
  const steps = page.locator(".stepper output");
  assert.ok(await page.getByRole("button", { name: "Next step" }).isDisabled());
  await pickRay(page);
  assert.match(await steps.textContent(), /^0 \/ \d+/);
  assert.match(await page.locator(".pane-step").first().textContent(), /Before the first of \d+ steps/);
  await page.getByRole("button", { name: "Next step" }).click();
  await page.keyboard.press("ArrowRight");
  assert.match(await steps.textContent(), /^2 \//);
  const after2 = await page.locator(".pane-step").allTextContents();
  assert.match(after2[0], /^2\/\d+: steps through node/);
  const picture = await pictureOf(page, 2);
  await page.keyboard.press("End");
  const ends = await page.locator(".pane-step").allTextContents();
  for (const end of ends) assert.match(end, /\(the end\)/);
  assert.notEqual(picture, await pictureOf(page, 2), "the last step looks as the second");
  await page.locator(".panes").scrollIntoViewIfNeeded();
  await screenshot(page, "structure-ray");
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  assert.deepEqual(await page.locator(".pane-step").allTextContents(), after2, "back and forth is not the same");
  await page.getByRole("button", { name: "Previous step" }).click();
  assert.match(await steps.textContent(), /^1 \//);
  // It plays by itself.
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction(() => Number(document.querySelector(".stepper output").textContent.split(" ")[0]) > 3);
  assert.deepEqual(wrong(problems), []);
  await close();
});

test("neighbour walks come to cells, the others go down", { skip: !browser }, async () => {
  const { page, close } = await openPage(browser, three(), { viewport: { width: 480, height: 400 } });
  await pickRay(page);
  const seen = [new Set(), new Set(), new Set()];
  const last = Number((await page.locator(".stepper output").textContent()).split("/")[1].replaceAll(",", ""));
  for (let step = 1; step <= Math.min(last, 24); ++step) {
    await page.keyboard.press("ArrowRight");
    const texts = await page.locator(".pane-step").allTextContents();
    texts.forEach((text, i) => seen[i].add(text.match(/: (\w+ \w+ \w+)/)?.[1]));
  }
  assert.ok([...seen[2]].some((words) => /^(comes to the|passes an empty)/.test(words)), [...seen[2]].join("; "));
  assert.ok(![...seen[0]].some((words) => /^(comes to the|passes an empty)/.test(words)), [...seen[0]].join("; "));
  await close();
});

test("nodes are picked in the view and in the map", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, three());
  const canvas = page.locator(".pane canvas").nth(1);
  const box = await canvas.boundingBox();
  // Somewhere there is a box of level 3.
  await page.getByLabel("First level shown").fill("3");
  await page.getByLabel("Last level shown").fill("3");
  await canvas.click({ position: { x: box.width / 2, y: box.height / 2 } });
  const details = page.locator(".details");
  assert.match(await details.textContent(), /structurekdtree/);
  assert.match(await details.textContent(), /level 3/);
  assert.equal(await page.locator("#treemap-structure").inputValue(), "1", "the map shows another structure");
  await details.getByRole("button", { name: "root" }).click();
  assert.match(await details.textContent(), /100 % of the root/);

  const map = page.locator(".treemap-box");
  await map.scrollIntoViewIfNeeded();
  const area = await map.boundingBox();
  // Some places are frames of the root's own tile.
  for (const [x, y] of [[0.3, 0.5], [0.35, 0.6], [0.6, 0.45]]) {
    if (!/100 % of the root/.test(await details.textContent())) break;
    await page.mouse.click(area.x + area.width * x, area.y + area.height * y);
  }
  assert.doesNotMatch(await details.textContent(), /100 % of the root/, "a tile does not select its node");
  await screenshot(page, "structure-desktop");
  assert.deepEqual(wrong(problems), []);
  await close();
});

test("a ray is picked in the view", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, three());
  await page.getByLabel("A click picks").selectOption("ray");
  const canvas = page.locator(".pane canvas").first();
  const box = await canvas.boundingBox();
  // Not every place shows a surface.
  for (const [x, y] of [[0.5, 0.5], [0.5, 0.6], [0.4, 0.55], [0.6, 0.7]]) await canvas.click({ position: { x: box.width * x, y: box.height * y } });
  assert.match(await page.locator(".stepper output").textContent(), /^0 \/ [1-9]/);
  assert.deepEqual(wrong(problems), []);
  await close();
});

test("on a phone nothing is wider than the screen, and touching steps a ray", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, three(), { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  assert.ok((await overflow(page)) <= 0, `${await overflow(page)} pixels too wide`);
  const canvas = page.locator(".picture canvas");
  await canvas.scrollIntoViewIfNeeded();
  await canvas.tap();
  await page.getByRole("button", { name: "Last step" }).tap();
  await screenshot(page, "structure-phone");
  assert.ok((await overflow(page)) <= 0, `${await overflow(page)} pixels too wide with a ray`);
  assert.deepEqual(wrong(problems), []);
  await close();
});

test("it is dark where the reader wants that", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, pageOf("builtin:spheres?primitives=2000", "bvh:arity=8"), { colorScheme: "dark" });
  const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.ok(background.match(/\d+/g).every((channel) => Number(channel) < 64), background);
  await pickRay(page, 0.5, 0.5);
  await page.keyboard.press("End");
  await screenshot(page, "structure-dark");
  assert.deepEqual(wrong(problems), []);
  await close();
});
