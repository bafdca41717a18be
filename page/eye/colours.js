/* Colour spaces: three planes in about 0..1 of a photo { data, width, height }, four bytes a pixel, as OpenCV makes
   them for vmc_lib/where/appearance.py, to the bit. */
import { single } from "./filters.js";

const TINY = 2 ** -23, UNITS = Float32Array.from({ length: 256 }, (_, byte) => byte / 255);

const HSV = ({ data, width, height }) => {
  const planes = [0, 1, 2].map(() => new Float32Array(width * height)), [hue, saturation, value] = planes;
  for (let i = 0; i < hue.length; i++) {
    const r = UNITS[data[4 * i]], g = UNITS[data[4 * i + 1]], b = UNITS[data[4 * i + 2]];
    const top = Math.max(r, g, b), range = single(top - Math.min(r, g, b));
    const turn = r === top ? g - b : g === top ? b - r : r - g;
    const start = r === top ? (g < b ? 360 : 0) : g === top ? 120 : 240;
    hue[i] = single(single(turn) * single(60 / single(range + TINY)) + start) / 360;
    saturation[i] = range / single(top + TINY);
    value[i] = top;
  }
  return planes;
};

/* Lab lies between the points of a grid of 33 colours a side, 16 steps apart, in whole numbers. */
const STEPS = Int32Array.from(UNITS, (unit) => Math.round(unit * 16384) >> 5), ONE = [16384, 16320, 16320];
const edge = (grid, at, b) => grid[at] * (16 - b) + grid[at + 3] * b;
const face = (grid, at, g, b) => edge(grid, at, b) * (16 - g) + edge(grid, at + 3 * 33, b) * g;
const Lab = ({ data, width, height }, grid) => {
  const planes = [0, 1, 2].map(() => new Float32Array(width * height));
  for (let i = 0; i < width * height; i++) {
    const r = STEPS[data[4 * i]], g = STEPS[data[4 * i + 1]], b = STEPS[data[4 * i + 2]];
    const [x, y, z] = [Math.min(r >> 4, 31), Math.min(g >> 4, 31), Math.min(b >> 4, 31)];
    const corner = 3 * ((x * 33 + y) * 33 + z), [red, green, blue] = [r - 16 * x, g - 16 * y, b - 16 * z];
    for (let c = 0; c < 3; c++) {
      const [dark, light] = [corner + c, corner + c + 3 * 33 * 33].map((at) => face(grid, at, green, blue));
      planes[c][i] = ((dark * (16 - red) + light * red + 2048) >> 12) / ONE[c];
    }
  }
  return planes;
};

export const colourSpaces = { HSV, Lab };
