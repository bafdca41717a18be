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
    const k = unit.length, along = new Float64Array(k), predicted = [0, 0, 0];
    let square = 0;
    features.forEach((x, i) => {
      const off = x - middle[i];
      square += off * off;
      for (let j = 0; j < k; j++) along[j] += off * axes[i * k + j];
    });
    for (let j = 0; j < k; j++) along[j] *= unit[j];
    squares.forEach((own, i) => {
      let shared = 0;
      for (let j = 0; j < k; j++) shared += along[j] * centres[i * k + j];
      const like = Math.exp(-gamma * (square + own - 2 * shared));
      for (let c = 0; c < 3; c++) predicted[c] += like * weights[3 * i + c];
    });
    return predicted.map((x, c) => mean[c] + spread[c] * x);
  };

  /* The place (3,) of a shuttlecock in a box, m; null where the line of sight does not meet its height. */
  const locate = (localiser, photo, box, camera) => {
    const [right, down, height] = predictPlace(localiser, describeBox(photo, box)), [x0, y0, x1, y1] = box;
    const pixel = [(x0 + x1) / 2 + right * (x1 - x0), (y0 + y1) / 2 + down * (y1 - y0)];
    return vmcEye.backProject(camera, pixel, height * localiser.side);
  };

  return { locate };
})());
