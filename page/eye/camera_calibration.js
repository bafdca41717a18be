/* Camera calibration from the corners of markers, as OpenCV does it for vmc_lib/marker_sheet.py: they are refined
   to a share of a pixel, and a camera is fitted to them. `sheet` is what Python gives (book/figures/your_photo.py). */
import { multiply, rotation as rotationAround } from "../demo/anatomy.js";
import { clip, dot, mean, minus, plus, solve, times } from "../vectors.js";
import { project } from "./camera.js";

const ROUNDS = 30, CLOSE = 0.1; // OpenCV's settings of a corner's refinement

/* A corner moved to where all steps of brightness around it point past it (Förstner & Gülch 1987). */
export const refineCorner = (levels, width, height, start, reach) => {
  const at = (x, y) => { // between pixels, a mixture
    const [cx, cy] = [clip(x, 0, width - 1), clip(y, 0, height - 1)];
    const i = Math.min(Math.floor(cx), width - 2), j = Math.min(Math.floor(cy), height - 2), k = j * width + i;
    const interpolate = (k) => levels[k] + (cx - i) * (levels[k + 1] - levels[k]);
    return interpolate(k) + (cy - j) * (interpolate(k + width) - interpolate(k));
  };
  let place = start;
  for (let round = 0; round < ROUNDS; round++) {
    let a = 0, b = 0, c = 0, right = 0, down = 0;
    for (let j = -reach; j <= reach; j++)
      for (let i = -reach; i <= reach; i++) {
        const [x, y] = plus(place, [i, j]), weight = Math.exp(-(i * i + j * j) / reach ** 2);
        const dx = at(x + 1, y) - at(x - 1, y), dy = at(x, y + 1) - at(x, y - 1);
        const [xx, xy, yy] = [weight * dx * dx, weight * dx * dy, weight * dy * dy];
        a += xx; b += xy; c += yy;
        right += xx * i + xy * j;
        down += xy * i + yy * j;
      }
    const area = a * c - b * b;
    if (Math.abs(area) < 1e-30) break;
    const step = [(c * right - b * down) / area, (a * down - b * right) / area], moved = plus(place, step);
    if (moved.some((x, k) => !(x >= 0 && x < [width, height][k]))) break;
    place = moved;
    if (Math.hypot(...step) <= CLOSE) break;
  }
  return minus(place, start).some((x) => Math.abs(x) > reach) ? start : place;
};

/* Least squares: how much of each column makes up `wanted`; damped as Marquardt does. */
const leastSquares = (columns, wanted, damping = 0) => solve(
  columns.map((one, i) => columns.map((other, j) => dot(one, other) * (i === j ? 1 + damping : 1))),
  columns.map((column) => dot(column, wanted)));

const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const unit = (a) => times(1 / Math.hypot(...a), a);
const combine = (amounts, vectors) => vectors.map((vector, k) => times(amounts[k], vector)).reduce(plus);

/* A camera to which flat points (x, y) of the sheet appear about at `pixels`, if its focal length is as long as
   the picture is wide: the eight numbers of a projection, made a turn and a place (Zhang 2000). */
const guess = (points, pixels, centre, { axes, first }) => {
  const focal = 2 * centre[0], near = pixels.map((pixel) => times(1 / focal, minus(pixel, centre)));
  const rows = points.flatMap(([x, y], i) => {
    const [u, v] = near[i];
    return [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]];
  });
  const h = [...leastSquares(rows[0].map((_, k) => rows.map((row) => row[k])), near.flat()), 1];
  const [right, along, shift] = [0, 1, 2].map((k) => [h[k], h[k + 3], h[k + 6]]);
  const x = unit(right), z = unit(cross(x, along)), y = cross(z, x);
  const rotation = [0, 1, 2].map((i) => combine([x[i], y[i], z[i]], axes));
  return { focal, centre, rotation, position: minus(first, combine(times(1 / Math.hypot(...right), shift), rotation)) };
};

/* A camera changed by seven numbers: its focal length, a small turn of the `pivot` that it looks at, and where
   it sees that, all as shares; two more move its middle, in focal lengths. */
const changeCamera = (camera, pivot, [longer, ...by]) => {
  const [across = 0, down = 0] = by.slice(6), centre = plus(camera.centre, times(camera.focal, [across, down]));
  const turn = by.slice(0, 3), angle = Math.hypot(...turn) || 1e-300;
  const seen = camera.rotation.map((axis) => dot(axis, minus(pivot, camera.position)));
  const rotation = multiply(rotationAround(times(1 / angle, turn), angle), camera.rotation);
  const position = minus(pivot, combine(plus(seen, times(seen[2], by.slice(3, 6))), rotation));
  return { focal: camera.focal * (1 + longer), centre, rotation, position };
};

/* The standard error of the first of the unknowns that a fit with such slopes leaves such errors. */
const standardError = (slopes, error) => {
  const normal = slopes.map((one) => slopes.map((other) => dot(one, other)));
  const [variance] = solve(normal, slopes.map((_, k) => +(k === 0)));
  return Math.sqrt((dot(error, error) / (error.length - slopes.length)) * variance);
};

/* The camera whose pictures of `places` (n, 3) lie nearest to `pixels` (Levenberg and Marquardt); how far
   off they are, in pixels, as `error`; and the standard error of its focal length, over it, as `spread`. */
const fit = (camera, places, pixels, unknowns) => {
  const pivot = mean(places), residuals = (one) => places.flatMap((place, i) => minus(pixels[i], project(one, place)));
  const each = (value) => Array.from({ length: unknowns }, (_, k) => value(k));
  const nudge = (k, by) => residuals(changeCamera(camera, pivot, each((i) => (i === k ? by : 0))));
  const square = (error) => dot(error, error);
  const slopesOf = () => each((k) => times(5e5, minus(nudge(k, -1e-6), nudge(k, 1e-6))));
  let error = residuals(camera), damping = 1e-3;
  for (let round = 0; round < 100 && damping < 1e12; round++) {
    const next = changeCamera(camera, pivot, leastSquares(slopesOf(), error, damping)), left = residuals(next);
    const gain = square(error) - square(left), small = Math.abs(gain) < 1e-12 * square(error);
    damping *= gain > 0 ? 0.1 : 10;
    if (gain > 0) [camera, error] = [next, left];
    if (small) break;
  }
  const spread = standardError(slopesOf(), error);
  return { ...camera, error: Math.sqrt(square(error) / places.length), spread };
};

/* The camera, in the photo's pixels, to which corners (n, 4, 2) of the markers `ids` appear; one that is `near` a
   camera may look past the photo's middle. */
export const calibrateCamera = (ids, corners, width, height, sheet, near = null) => {
  const points = ids.flatMap((id) => sheet.markers[id]), centre = [width / 2, height / 2];
  const pixels = corners.flat().map((corner) => plus(corner, [0.5, 0.5])); // from the middle of a pixel
  const places = points.map((point) => plus(sheet.first, combine(point, sheet.axes.slice(0, 2))));
  return fit(near ?? guess(points, pixels, centre, sheet), places, pixels, near ? 9 : 7);
};
