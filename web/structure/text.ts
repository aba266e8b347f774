// Numbers and elements as text.

const whole = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

export function integer(value: number): string {
  return whole.format(value);
}

/** Three digits that count. */
export function short(value: number): string {
  if (!Number.isFinite(value)) return "none";
  if (Number.isInteger(value) && Math.abs(value) < 1e6) return integer(value);
  const size = Math.abs(value);
  return size >= 1e6 || (size < 1e-3 && size > 0) ? value.toExponential(2) : String(Number(value.toPrecision(3)));
}

export function percent(share: number): string {
  return `${short(100 * share)} %`;
}

type Child = Node | string;

/** An element with attributes and what is in it. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const result = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) result.setAttribute(name, value);
  result.append(...children);
  return result;
}
