// The colours of heat maps: from dark blue over red to pale yellow, with lightness growing evenly, so that they can be told apart in grey
// and by people who see fewer colours.

/** How many colours there are. */
export const colorCount = 256;

/** Red, green, blue and 255 of each colour, from least to most. */
export const colors = makeColors();

function makeColors(): Uint8ClampedArray {
  const all = new Uint8ClampedArray(4 * colorCount);
  for (let i = 0; i < colorCount; ++i) {
    const at = i / (colorCount - 1);
    const lightness = 0.16 + 0.81 * at;
    const chroma = 0.17 * Math.sin(Math.PI * (0.12 + 0.8 * at)) + 0.01;
    const hue = ((270 + 195 * at) * Math.PI) / 180;
    all.set([...rgb(lightness, chroma, hue), 255], 4 * i);
  }
  return all;
}

/** Oklab in polar form (Ottosson 2020, "A perceptual color space for image processing") to sRGB, 0 to 255. */
function rgb(lightness: number, chroma: number, hue: number): [number, number, number] {
  const [a, b] = [chroma * Math.cos(hue), chroma * Math.sin(hue)];
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const encode = (linear: number) => 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
  return [
    encode(Math.max(0, 4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
    encode(Math.max(0, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
    encode(Math.max(0, -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s)),
  ];
}

/** The scale from left to right as a background of CSS. */
export function gradient(): string {
  const stops = Array.from({ length: 17 }, (_, index) => {
    const at = 4 * Math.round((index / 16) * (colorCount - 1));
    return `rgb(${colors[at]} ${colors[at + 1]} ${colors[at + 2]})`;
  });
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
