// The results that a page shows: JSON in an element of the page, put there by whoever made the report.

/** The report's data, or null in a page without any. */
export function readData(): unknown {
  const text = document.getElementById("grove-data")?.textContent;
  if (!text) return null;
  const data: unknown = JSON.parse(text);
  // The mark that is replaced is itself valid JSON.
  return typeof data === "string" ? null : data;
}
