// Figures that only this page has, as text.

import { number } from "../shared/format";

export function percent(share: number): string {
  return `${number(100 * share)} %`;
}
