// Figures as text.

/** What stands where there is no figure. */
export const missing = "–";

const thin = "\u202f";

/** Three significant digits, with separators from a thousand on. */
export function number(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || Number.isNaN(value)) return missing;
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size >= 1000) return signed(Math.round(value).toLocaleString("en-US"));
  if (size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 1)).split("e");
    return `${signed(mantissa ?? "")}·10${superscript(Number(exponent))}`;
  }
  return signed(size >= 100 ? value.toFixed(0) : value.toPrecision(digits));
}

/** A whole number with separators. */
export function count(value: number | null | undefined): string {
  return value === null || value === undefined ? missing : signed(Math.round(value).toLocaleString("en-US"));
}

/** For axes and where room is scarce: 1,024, 25k, 2.5M, 10G; small numbers as they are. */
export function compact(value: number): string {
  const size = Math.abs(value);
  if (size >= 1000 && size < 10000) return count(value);
  for (const [unit, factor] of [
    ["G", 1e9],
    ["M", 1e6],
    ["k", 1e3],
  ] as const) {
    if (size >= factor) return signed(trim((value / factor).toPrecision(3))) + unit;
  }
  if (size === 0) return "0";
  if (size < 1e-3) return signed(`10${superscript(Math.round(Math.log10(size)))}`);
  return signed(trim(value.toPrecision(3)));
}

/** B, KiB, MiB or GiB. */
export function bytes(value: number | null | undefined): string {
  if (value === null || value === undefined) return missing;
  const units = ["B", "KiB", "MiB", "GiB", "TiB"];
  let unit = 0;
  let left = value;
  while (left >= 1024 && unit + 1 < units.length) {
    left /= 1024;
    ++unit;
  }
  return (unit === 0 ? count(left) : number(left)) + thin + (units[unit] ?? "");
}

/** ns, µs, ms, s, min or h. */
export function duration(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined) return missing;
  if (seconds >= 5400) return number(seconds / 3600) + thin + "h";
  if (seconds >= 120) return number(seconds / 60) + thin + "min";
  if (seconds >= 1 || seconds === 0) return number(seconds) + thin + "s";
  if (seconds >= 1e-3) return number(seconds * 1e3) + thin + "ms";
  if (seconds >= 1e-6) return number(seconds * 1e6) + thin + "µs";
  return number(seconds * 1e9) + thin + "ns";
}

/** Bytes for axes, without digits that say nothing: powers of ten in kB, MB and GB, else as `bytes`. */
export function bytesTick(value: number): string {
  const decade = Math.log10(value);
  if (value >= 1000 && Math.abs(decade - Math.round(decade)) < 1e-6) {
    const thousands = Math.min(4, Math.floor(Math.round(decade) / 3));
    return `${Math.round(value / 1000 ** thousands)}${thin}${["B", "kB", "MB", "GB", "TB"][thousands]}`;
  }
  return bytes(value).replace(/\.0+(?=\u202f)/, "");
}

/** Seconds for axes whose ticks are decades: never minutes or hours, and without digits that say nothing. */
export function secondsTick(value: number): string {
  return value >= 1 ? count(value) + thin + "s" : duration(value).replace(/\.0+(?=\u202f)/, "");
}

/** A date of ISO 8601 as people write it, in UTC. */
export function date(iso: string): string {
  const parsed = new Date(iso);
  if (Number.isNaN(parsed.getTime())) return iso;
  const format = new Intl.DateTimeFormat("en-GB", {
    dateStyle: "long",
    timeStyle: "short",
    timeZone: "UTC",
  });
  return `${format.format(parsed)} UTC`;
}

/** The singular for one, else the plural. */
export function plural(amount: number, one: string, many = `${one}s`): string {
  return `${count(amount)} ${amount === 1 ? one : many}`;
}

function signed(text: string): string {
  return text.replace("-", "−");
}

function trim(text: string): string {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

function superscript(exponent: number): string {
  return String(exponent).replace(/./g, (c) => (c === "-" ? "⁻" : ("⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)] ?? "")));
}
