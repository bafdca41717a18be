/* A pinhole camera: projection, and back-projection of pixels onto a horizontal plane (vmc_lib/camera.py). */
import { dot, minus, plus, times } from "../vectors.js";

/* The pixel at which a point of the room appears. */
export const project = ({ focal, centre, rotation, position }, point) => {
  const [x, y, z] = rotation.map((axis) => dot(axis, minus(point, position)));
  return plus(centre, times(focal / Math.max(z, 1e-6), [x, y]));
};

/* The ray through a pixel, its depth 1, and the depth at which it meets a height. */
const sightLine = ({ focal, centre, rotation, position }, pixel, height) => {
  const [x, y] = times(1 / focal, minus(pixel, centre));
  const ray = rotation[0].map((_, k) => dot([x, y, 1], rotation.map((axis) => axis[k])));
  return { ray, depth: (height - position[1]) / ray[1] };
};

/* Where the ray through a pixel meets a height. */
export const backProject = (camera, pixel, height) => {
  const { ray, depth } = sightLine(camera, pixel, height);
  return plus(camera.position, times(depth, ray));
};

/* The physical size of what fills a box, if it stands on the table: the root of its area; beyond the horizon
   Infinity. */
export const physicalSize = (camera, [x0, y0, x1, y1], table) => {
  const { depth } = sightLine(camera, [(x0 + x1) / 2, y1], table); // of its foot
  return depth > 0 ? (Math.sqrt((x1 - x0) * (y1 - y0)) * depth) / camera.focal : Infinity;
};

/* A guess at the camera of a phone's photo, its middle and its diagonal in pixels: with a usual `lens`, held at a slant,
   from where what fills a box is as large as a shuttlecock and lies in a place. Were that `nearest` or nearer, the photo is
   part of one from there. */
export const guessCamera = ([x0, y0, x1, y1], { lens, slant, size, place, nearest }, centre, diagonal) => {
  const pixels = Math.sqrt((x1 - x0) * (y1 - y0)) / size; // for a metre, there
  const focal = Math.max(lens * diagonal, nearest * pixels), away = focal / pixels, [c, s] = [Math.cos(slant), Math.sin(slant)];
  const rotation = [[0, 0, 1], [-s, -c, 0], [c, -s, 0]], pixel = [(x0 + x1) / 2, (y0 + y1) / 2];
  const ray = [...times(1 / focal, minus(pixel, centre)), 1];
  const position = minus(place, [0, 1, 2].map((k) => away * dot(ray, rotation.map((axis) => axis[k]))));
  return { focal, centre, rotation, position };
};
