/* Finds ArUco markers in a grey picture, as OpenCV's detector does for vmc_lib/marker_sheet.py: dark connected
   patches with four corners, inside which lies one of the known patterns. */
import { distance, mean, sum } from "../vectors.js";

const CELLS = 6, SMALLEST = 10, FEWEST = 20; // of a marker: cells a side, frame included; pixels a side, in all
const DARKER = 7, AROUND = [2, 6, 11].map((pixels) => pixels / 600); // grey levels; of the picture's longer side

/* Which pixels are darker than the mean of the square around them, `reach` pixels each way: 0 or 1. */
const darkPixels = (grey, width, height, reach) => {
  const sums = new Float64Array((width + 1) * (height + 1)), dark = new Uint8Array(width * height);
  for (let y = 0, i = 0; y < height; y++)
    for (let x = 0, row = 0; x < width; x++, i++) {
      row += grey[i];
      sums[(y + 1) * (width + 1) + x + 1] = sums[y * (width + 1) + x + 1] + row;
    }
  for (let y = 0, i = 0; y < height; y++) {
    const top = Math.max(0, y - reach), bottom = Math.min(height, y + reach + 1);
    for (let x = 0; x < width; x++, i++) {
      const left = Math.max(0, x - reach), right = Math.min(width, x + reach + 1);
      const above = top * (width + 1), below = bottom * (width + 1);
      const total = sums[below + right] - sums[below + left] - sums[above + right] + sums[above + left];
      dark[i] = +(grey[i] + DARKER < total / ((right - left) * (bottom - top)));
    }
  }
  return dark;
};

/* The pixels of each connected patch that may be a marker, one after the other; `dark` is emptied. */
function* patches(dark, width, height) {
  const found = new Int32Array(dark.length);
  let end = 0;
  const take = (pixel) => {
    dark[pixel] = 0;
    found[end++] = pixel;
  };
  for (let first = 0; first < dark.length; first++) {
    if (!dark[first]) continue;
    const start = end;
    take(first);
    for (let next = start; next < end; next++) {
      const x = found[next] % width, y = (found[next] - x) / width;
      for (let v = Math.max(0, y - 1); v <= Math.min(height - 1, y + 1); v++)
        for (let u = Math.max(0, x - 1); u <= Math.min(width - 1, x + 1); u++)
          if (dark[v * width + u]) take(v * width + u);
    }
    if (end - start >= FEWEST) yield found.subarray(start, end);
  }
}

const apart = ([x, y], u, v) => Math.hypot(x - u, y - v);
const side = ([x0, y0], [x1, y1], x, y) => (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0); // > 0: to the right

/* The four corners of a patch, clockwise; null where it is no quadrilateral. */
const corners = (patch, width) => {
  const xs = patch.map((pixel) => pixel % width), ys = patch.map((pixel) => pixel / width); // whole numbers
  const farthest = (measure) => {
    let best = 0, most = -Infinity;
    for (let i = 0; i < xs.length; i++) {
      const far = measure(xs[i], ys[i]);
      if (far > most) [best, most] = [i, far];
    }
    return [xs[best], ys[best]];
  };
  const middle = [xs, ys].map((places) => sum(places) / patch.length);
  const a = farthest((x, y) => apart(middle, x, y)), c = farthest((x, y) => apart(a, x, y));
  const b = farthest((x, y) => -side(a, c, x, y)), d = farthest((x, y) => side(a, c, x, y));
  const quad = [a, b, c, d], next = [b, c, d, a];
  const sides = quad.map((corner, i) => distance(corner, next[i])), longest = Math.max(...sides);
  const halves = [-side(a, c, ...b), side(a, c, ...d)];
  if (Math.min(...sides) < SMALLEST || Math.min(...halves) < 0.3 * Math.max(...halves)) return null;
  const within = (corner, i) => {
    const least = -(1 + 0.03 * longest) * sides[i];
    return xs.every((x, k) => side(corner, next[i], x, ys[k]) > least);
  };
  return quad.every(within) ? quad : null;
};

/* Where the points of the unit square lie in a quadrilateral (Heckbert 1989). */
const intoQuad = ([[x0, y0], [x1, y1], [x2, y2], [x3, y3]]) => {
  const [ax, bx, cx] = [x1 - x2, x3 - x2, x0 - x1 + x2 - x3], [ay, by, cy] = [y1 - y2, y3 - y2, y0 - y1 + y2 - y3];
  const area = ax * by - bx * ay, g = (cx * by - bx * cy) / area, h = (ax * cy - cx * ay) / area;
  return (u, v) => [
    ((x1 - x0 + g * x1) * u + (x3 - x0 + h * x3) * v + x0) / (g * u + h * v + 1),
    ((y1 - y0 + g * y1) * u + (y3 - y0 + h * y3) * v + y0) / (g * u + h * v + 1),
  ];
};

/* How bright each cell of a quadrilateral is, row by row: the mean of nine pixels about its middle. */
const cellBrightness = (grey, width, quad) => {
  const at = intoQuad(quad), inCell = [1 / 3, 1 / 2, 2 / 3];
  return Array.from({ length: CELLS * CELLS }, (_, i) => {
    const places = inCell.flatMap((down) =>
      inCell.map((right) => at(((i % CELLS) + right) / CELLS, (Math.floor(i / CELLS) + down) / CELLS)));
    return sum(places.map(([x, y]) => grey[Math.round(y) * width + Math.round(x)])) / places.length;
  });
};

const inFrame = (_, i) => [i % CELLS, Math.floor(i / CELLS)].some((place) => place % (CELLS - 1) === 0);
const quarterTurn = (bits) => bits.map((_, i) => bits[(3 - (i % 4)) * 4 + Math.floor(i / 4)]);

/* Which of `codes` (16 bits each, 1 for white) a quadrilateral shows, and its corners from that marker's
   upper left one, clockwise; null where it shows none. */
const identify = (grey, width, quad, codes) => {
  const cells = cellBrightness(grey, width, quad), half = (Math.min(...cells) + Math.max(...cells)) / 2;
  if (cells.filter(inFrame).some((light) => light > half)) return null;
  let bits = cells.filter((light, i) => !inFrame(light, i)).map((light) => +(light > half));
  for (let turns = 0; turns < 4; turns++, bits = quarterTurn(bits)) {
    const id = codes.findIndex((code) => code.every((bit, i) => bit === bits[i]));
    if (id >= 0) return { id, corners: quad.map((_, i) => quad[(i + 4 - turns) % 4]) };
  }
  return null;
};

/* The markers { id, corners } in a picture, until there are `enough`; a marker of which there are two, twice. What
   is dark in a picture depends on how far around one looks. */
export function* findMarkers(grey, width, height, codes, enough = codes.length) {
  const found = [];
  for (const share of AROUND) {
    const dark = darkPixels(grey, width, height, Math.round(share * Math.max(width, height)));
    yield;
    for (const patch of patches(dark, width, height)) {
      const quad = corners(patch, width), marker = quad && identify(grey, width, quad, codes);
      const same = ({ id, corners }) => id === marker.id && distance(mean(corners), mean(quad)) < SMALLEST;
      if (marker && !found.some(same)) found.push(marker);
      yield;
    }
    if (found.length >= enough) break;
  }
  return found;
}
