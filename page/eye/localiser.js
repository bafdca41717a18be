/* The localiser: from a box in the photo to a place in the shoulder frame (vmc_lib/where/localiser.py), in the main
   directions of what it has learnt (page/eye/localiser.py). */
import { dot, minus } from "../vectors.js";
import { backProject } from "./camera.js";
import { crop, gradients } from "./features.js";
import { addProduct, product, radialBasis } from "./product.js";

/* Features of a box: gradients, coarse and fine, raw pixels, and the logarithms of its sides. */
const describeBox = (photo, box) => {
  const [x0, y0, x1, y1] = box, outlines = [[8, 0], [10, 0.25], [14, 0.1]];
  return [
    ...outlines.flatMap(([cells, margin]) => [...gradients(photo, box, cells, margin)]),
    ...crop(photo, box, 16).map((x) => 0.3 * x),
    Math.log(x1 - x0), Math.log(y1 - y0),
  ];
};

/* What the regression predicts of features: right and down in sides of the box, height in units of `side`. */
const predictPlace = ({ axes, centres, unit, middle, squares, weights, mean, spread, gamma }, features) => {
  const x = features.map((feature, i) => feature - middle[i]), square = dot(x, x);
  const along = product(axes, x).map((sum, i) => sum * unit[i]);
  const predicted = addProduct([0, 0, 0], radialBasis(gamma, along, square, centres, squares), weights);
  return predicted.map((x, c) => mean[c] + spread[c] * x);
};

/* The place (3,) of a shuttlecock in a box, m. RangeError where the line of sight does not meet its height. */
export const locate = (localiser, photo, box, camera) => {
  const [right, down, height] = predictPlace(localiser, describeBox(photo, box)), [x0, y0, x1, y1] = box;
  const pixel = [(x0 + x1) / 2 + right * (x1 - x0), (y0 + y1) / 2 + down * (y1 - y0)];
  const place = backProject(camera, pixel, height * localiser.side);
  if (!(dot(camera.rotation[2], minus(place, camera.position)) > 0))
    throw new RangeError(`a ray through ${pixel} never meets the table`);
  return place;
};
