/* The localiser: from a box in the photo to a place in the shoulder frame (vmc_lib/where/localiser.py), in the main
   directions of what it has learnt (eye_in_page/localiser.py). */
Object.assign(vmcEye, (() => {
  "use strict";

  /* Features of a box: gradients, coarse and fine, raw pixels, and the logarithms of its sides. */
  const describeBox = (photo, box) => {
    const [x0, y0, x1, y1] = box, outlines = [[8, 0], [10, 0.25], [14, 0.1]];
    return [
      ...outlines.flatMap(([cells, margin]) => [...vmcEye.gradients(photo, box, cells, margin)]),
      ...vmcEye.crop(photo, box, 16).map((x) => 0.3 * x),
      Math.log(x1 - x0), Math.log(y1 - y0),
    ];
  };

  /* What the regression predicts of features: right and down in sides of the box, height in units of `side`. */
  const predictPlace = ({ axes, centres, unit, middle, squares, weights, mean, spread, gamma }, features) => {
    const x = features.map((feature, i) => feature - middle[i]), square = vmcVectors.dot(x, x);
    const along = vmcEye.product(axes, x).map((sum, i) => sum * unit[i]);
    const predicted = vmcEye.addProduct([0, 0, 0], vmcEye.radialBasis(gamma, along, square, centres, squares), weights);
    return predicted.map((x, c) => mean[c] + spread[c] * x);
  };

  /* The place (3,) of a shuttlecock in a box, m. RangeError where the line of sight does not meet its height. */
  const locate = (localiser, photo, box, camera) => {
    const [right, down, height] = predictPlace(localiser, describeBox(photo, box)), [x0, y0, x1, y1] = box;
    const pixel = [(x0 + x1) / 2 + right * (x1 - x0), (y0 + y1) / 2 + down * (y1 - y0)];
    const place = vmcEye.backProject(camera, pixel, height * localiser.side);
    if (!(vmcVectors.dot(camera.rotation[2], vmcVectors.minus(place, camera.position)) > 0))
      throw new RangeError(`a ray through ${pixel} never meets the table`);
    return place;
  };

  return { locate };
})());
