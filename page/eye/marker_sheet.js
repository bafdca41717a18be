/* A photo of the printed sheet: its camera, and the photo without the sheet (vmc_lib/marker_sheet.py). A photo is
   { data, width, height }, four bytes a pixel; `sheet` is what Python gives (book/figures/your_photo.py). */
import { distance, dot, minus, plus, sum, times } from "../vectors.js";
import { project } from "./camera.js";
import { calibrateCamera, refineCorner } from "./camera_calibration.js";
import { findMarkers } from "./markers.js";
import { each } from "./pieces.js";

const WINDOW = 5, SHARE = 0.3 / 6; // how far around a corner OpenCV refines it: pixels, of a marker's side

/* Grey levels, rounded as OpenCV rounds them. */
const greyLevels = ({ data, width, height }) => {
  const levels = new Uint8Array(width * height);
  for (let i = 0; i < levels.length; i++)
    levels[i] = (4899 * data[4 * i] + 9617 * data[4 * i + 1] + 1868 * data[4 * i + 2] + 8192) >> 14;
  return levels;
};

/* A marker's code in a mirror. */
const mirrorCode = (code) => code.map((_, i) => code[i - (i % 4) + 3 - (i % 4)]);

/* The camera of all markers; where these disagree by more than `most`, of all but one: it may be half covered. */
function* bestFit(calibrate, all, most, fewest) {
  const whole = calibrate(all);
  if (whole.error <= most || all.length === fewest) return whole;
  const others = yield* each(all, (one) => calibrate(all.filter((k) => k !== one)));
  return others.reduce((a, b) => (b.error < a.error ? b : a));
}

/* The markers { id, corners } that a photo shows, and its camera, of another `size` [width, height]; null where
   the markers are too few, or where they give none that can be: then `why` says so. Of a photo that is surely `whole`,
   as a film's frames are, it is not asked whether it was cropped. */
export function* readSheet(photo, sheet, size, whole = false) {
  const { width, height } = photo, levels = greyLevels(photo), { codes, fewest, refusals } = sheet;
  const patterns = [...codes, ...codes.map(mirrorCode)];
  const seen = yield* findMarkers(levels, width, height, patterns, codes.length);
  const markers = seen.filter(({ id }) => id < codes.length), ids = markers.map(({ id }) => id);
  const none = (why) => ({ markers, camera: null, why });
  if (ids.length < fewest) return none(seen.length - ids.length < fewest ? null : refusals.mirrored);
  if (new Set(ids).size < ids.length) return none(refusals.doubled);
  const refined = markers.map(({ corners }) => {
    const side = sum(corners.map((corner, i) => distance(corner, corners[(i + 1) % 4]))) / 4;
    const reach = Math.max(1, Math.min(WINDOW, Math.round(SHARE * side)));
    return corners.map((corner) => refineCorner(levels, width, height, corner, reach));
  });
  const scale = Math.min(size[0] / width, size[1] / height), most = sheet.residual / scale;
  const calibrate = (left, near) =>
    calibrateCamera(left.map((k) => ids[k]), left.map((k) => refined[k]), width, height, sheet, near);
  const all = [...ids.keys()], camera = yield* bestFit(calibrate, all, most, fewest), focal = scale * camera.focal;
  const other = whole ? camera : calibrate(all, camera), aside = scale * distance(other.centre, camera.centre);
  if (aside > sheet.aside && other.error < Math.min(most, sheet.gain * camera.error)) return none(refusals.cropped);
  if (!(camera.error <= most && camera.position[1] > sheet.first[1])) return none(refusals.uneven);
  if (!(sheet.focals[0] <= focal && focal <= sheet.focals[1] && camera.spread <= sheet.focalSpread)) return none(refusals.focal);
  return { markers, camera: { ...camera, focal, centre: times(0.5, size) }, why: null };
}

/* Whether a photo was taken from beyond the sheet, towards the reader's side: forwards, or what is up in it, then
   points back. */
export const fromBeyond = ({ rotation: [, down, forwards] }) => forwards[0] - down[0] < 0;

/* The sheet's outline in a camera's picture; what lies behind the camera is cut off (Sutherland & Hodgman). */
export const sheetOutline = (camera, { page, near }) => {
  const depth = page.map((corner) => dot(camera.rotation[2], minus(corner, camera.position)) - near);
  return page.flatMap((corner, k) => {
    const before = (k + page.length - 1) % page.length, share = depth[k] / (depth[k] - depth[before]);
    const cut = plus(corner, times(share, minus(page[before], corner)));
    return [...(depth[before] * depth[k] < 0 ? [cut] : []), ...(depth[k] >= 0 ? [corner] : [])];
  }).map((corner) => project(camera, corner));
};

const PLACES = 24, BRIGHT = 0.8; // along the paper's sides, where it is asked; the share that is darker than its white

/* The light (3,) on the sheet, 0 to 1: of white paper what a photo shows as white. */
export const paperLight = ({ data, width, height }, camera, { page: [a, b, , d] }) => {
  const shares = Array.from({ length: PLACES }, (_, i) => (i + 0.5) / PLACES);
  const places = shares.flatMap((u) => shares.map((v) => plus(a, plus(times(u, minus(b, a)), times(v, minus(d, a))))));
  const pixels = places.map((place) => project(camera, place).map(Math.round));
  const seen = pixels.filter(([x, y]) => x >= 0 && x < width && y >= 0 && y < height);
  return [0, 1, 2].map((k) => {
    const levels = seen.map(([x, y]) => data[4 * (y * width + x) + k]).sort((p, q) => p - q);
    return levels[Math.floor(BRIGHT * levels.length)] / 255;
  });
};

/* Of each row of a picture, the first and last pixel on or within a convex polygon, whose lines are drawn from
   their left ends as OpenCV draws them (Bresenham 1965). */
const polygonRows = (polygon, height) => {
  const rows = Array.from({ length: height }, () => [Infinity, -Infinity]);
  const corners = polygon.map((corner) => corner.map(Math.round));
  corners.forEach((corner, k) => {
    const [from, to] = [corner, corners[(k + 1) % corners.length]].sort((a, b) => a[0] - b[0]);
    const way = minus(to, from), steps = Math.max(1, ...way.map(Math.abs));
    for (let step = 0; step <= steps; step++) {
      const moved = way.map((side) => Math.sign(side) * Math.ceil((step / steps) * Math.abs(side) - 0.5));
      const [x, y] = plus(from, moved), row = rows[y];
      if (row) rows[y] = [Math.min(row[0], x), Math.max(row[1], x)];
    }
  });
  return rows;
};
const dilate = (rows, by) => rows.map((_, y) => {
  const near = rows.slice(Math.max(0, y - by), y + by + 1);
  return [Math.min(...near.map(([left]) => left)) - by, Math.max(...near.map(([, right]) => right)) + by];
});
const median = (values) => {
  const sorted = Uint8Array.from(values).sort(), half = sorted.length >> 1;
  return Math.floor((sorted[(sorted.length - 1) >> 1] + sorted[half]) / 2);
};

/* The photo, painted over within an outline, and a little beyond, in the colour around it. */
export const paintOver = ({ data, width, height }, polygon) => {
  const covered = dilate(polygonRows(polygon, height), 4), inside = [], ring = [];
  dilate(covered, 7).forEach(([left, right], y) => {
    const [from, to] = covered[y];
    for (let x = Math.max(0, left); x <= Math.min(right, width - 1); x++)
      (x >= from && x <= to ? inside : ring).push(y * width + x);
  });
  const bare = data.slice(), shown = ring.length ? ring : inside;
  for (const c of [0, 1, 2]) {
    const colour = median(shown.map((i) => data[4 * i + c]));
    for (const i of inside) bare[4 * i + c] = colour;
  }
  return { data: bare, width, height };
};
