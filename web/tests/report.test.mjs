import assert from "node:assert/strict";
import { after, test } from "node:test";
import { openPage, pageWith, startBrowser } from "./browser.mjs";

const browser = await startBrowser();
after(() => browser?.close());

test("a report without results says so", { skip: !browser }, async () => {
  const { page, problems, close } = await openPage(browser, pageWith("report", "Nothing", "nothing"));
  assert.equal(await page.title(), "Nothing");
  assert.deepEqual(problems, []);
  await close();
});
