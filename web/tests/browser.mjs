// What the tests of the pages share: a browser, pages with data in them, and screenshots. Where there is no browser or no driver for
// it, a line says so and the tests are skipped.

import { execFileSync } from "node:child_process";
import { accessSync, constants, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { pathToFileURL } from "node:url";

/** Where the built pages are, the grove command, and where screenshots go: given by whoever runs the tests. */
export const pagesFolder = process.env.GROVE_PAGES ?? "dist";
export const groveCommand = process.env.GROVE_COMMAND ?? "grove";
const screenshotFolder = process.env.GROVE_SCREENSHOTS ?? "screenshots";

/** A chromium that tests drive without a window, or null after a line that says what is missing. */
export async function startBrowser() {
  const executablePath = process.env.GROVE_CHROMIUM ?? "/usr/bin/chromium";
  try {
    accessSync(executablePath, constants.X_OK);
  } catch {
    return skip(`${executablePath} is not there; install the package chromium`);
  }
  let playwright;
  try {
    playwright = await import("playwright-core");
  } catch {
    return skip("playwright-core is not there; install the packages of web/package-lock.json with npm ci");
  }
  return playwright.chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu-sandbox"] });
}

function skip(reason) {
  console.log(`SKIPPED: ${reason}`);
  return null;
}

/** The text of a page with a title and data, as the command writes it. */
export function pageWith(page, title, data) {
  const json = JSON.stringify(data).replaceAll("<", "\\u003c");
  return readFileSync(join(pagesFolder, `${page}.html`), "utf8")
    .replace("@GROVE_TITLE@", () => title)
    .replace('"@GROVE_DATA@"', () => json);
}

const temporary = mkdtempSync(join(tmpdir(), "grove-web-"));
process.on("exit", () => rmSync(temporary, { recursive: true, force: true }));

/** A new folder, which is removed when the process ends. */
export function temporaryFolder() {
  return mkdtempSync(join(temporary, "folder-"));
}

/** Writes `html` to a file and opens that; `problems` collects errors of the page and requests for anything else. */
export async function openPage(browser, html, options = {}) {
  const file = join(temporaryFolder(), "page.html");
  writeFileSync(file, html);
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  context.setDefaultTimeout(10_000);
  const page = await context.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error.stack ?? error)));
  page.on("console", (message) => {
    if (message.type() === "error" || message.type() === "warning") problems.push(message.text());
  });
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) problems.push(`asks for ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href);
  return { page, problems, close: () => context.close() };
}

/** Saves what the page looks like, whole or what is seen of it. */
export async function screenshot(page, name, options = {}) {
  mkdirSync(screenshotFolder, { recursive: true });
  await page.screenshot({ path: join(screenshotFolder, `${name}.png`), fullPage: true, ...options });
}

/** By how many pixels the page is wider than its window, which a reader on a phone would have to scroll. */
export function overflow(page) {
  return page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
}

/** Scrolls through the whole page, so that everything in it has been in view. */
export async function scrollThrough(page) {
  await page.evaluate(async () => {
    for (let y = 0; y < document.body.scrollHeight; y += 500) {
      window.scrollTo(0, y);
      await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 20)));
    }
    window.scrollTo(0, 0);
  });
}

/** How many charts the page has, and how many of them are drawn. */
export function chartCounts(page) {
  return page.evaluate(() => {
    const charts = [...document.querySelectorAll(".chart")];
    return { all: charts.length, drawn: charts.filter((chart) => chart.querySelector("svg path")).length };
  });
}

/** Runs the grove command and returns what it wrote to its last argument, a file that is put in a folder of its own. */
export function runGrove(...command) {
  const file = join(temporaryFolder(), command.pop());
  execFileSync(groveCommand, [...command, file], { stdio: ["ignore", "ignore", "inherit"], cwd: dirname(file) });
  return readFileSync(file, "utf8");
}

/** The data in a page's text. */
export function dataOf(html) {
  return JSON.parse(/<script id="grove-data" type="application\/json">(.*?)<\/script>/s.exec(html)[1]);
}
