// What the tests of the pages share: a browser, pages with data in them, and screenshots. Where there is no browser or no driver for
// it, a line says so and the tests are skipped.

import { accessSync, constants, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
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

/** A folder that is removed when the process ends. */
export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), "grove-web-"));
  process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

/** Writes `html` to a file and opens that; `problems` collects errors of the page and requests for anything else. */
export async function openPage(browser, html, options = {}) {
  const file = join(temporaryFolder(), "page.html");
  writeFileSync(file, html);
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
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
