// Colours: those of the page come from its style sheet, which knows light, dark and print.

const dark = window.matchMedia("(prefers-color-scheme: dark)");
const print = window.matchMedia("print");

export interface Theme {
  text: string;
  muted: string;
  line: string;
  surface: string;
  accent: string;
  series: string[];
  families: Record<string, string>;
}

const families = ["brute", "octree", "kdtree", "bvh", "fast", "auto"];

/** The colours that hold now, or those of light pages for paper. */
export function currentTheme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const read = (name: string) => style.getPropertyValue(name).trim();
  return {
    text: read("--text"),
    muted: read("--muted"),
    line: read("--line"),
    surface: read("--surface"),
    accent: read("--accent"),
    series: Array.from({ length: 8 }, (_, index) => read(`--series-${index + 1}`)),
    families: Object.fromEntries(families.map((family) => [family, read(`--family-${family}`)])),
  };
}

/** Calls back when the colours of the page have changed. */
export function onThemeChange(changed: () => void): void {
  dark.addEventListener("change", changed);
}

/** Calls back before the page is put on paper, and after. */
export function onPrint(before: () => void, after: () => void): void {
  let printing = false;
  const set = (value: boolean) => {
    if (value === printing) return;
    printing = value;
    // The style sheet's rules for print do not hold yet when charts must be drawn for it.
    document.documentElement.classList.toggle("paper", printing);
    (printing ? before : after)();
  };
  window.addEventListener("beforeprint", () => set(true));
  window.addEventListener("afterprint", () => set(false));
  print.addEventListener("change", (event) => set(event.matches));
  if (print.matches) set(true);
}

/** "octree" of "octree:split=octree-r": the name before the keys. */
export function familyOf(structure: string): string {
  const family = structure.split(":")[0] ?? structure;
  return family === "octree-r" ? "octree" : family;
}
