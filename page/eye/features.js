/* What a box shows of a photo { data, width, height }, four bytes a pixel, as numbers (vmc_lib/photos.py, crops;
   vmc_lib/where/features.py). */
Object.assign(vmcEye, (() => {
  "use strict";

  const DIRECTIONS = 8, TURN = Math.fround(2 * Math.PI), single = Math.fround;

  /* A crop of size × size × 3 in 0..1: each pixel is the mean of four samples spread evenly over it. */
  const crop = ({ data, width, height }, [x0, y0, x1, y1], size) => {
    const samples = (low, high, limit) => Int32Array.from({ length: 2 * size }, (_, i) =>
      Math.min(Math.max(low + ((i + 0.5) / (2 * size)) * (high - low), 0), limit - 1));
    const xs = samples(x0, x1, width), ys = samples(y0, y1, height), pixels = new Float32Array(3 * size * size);
    for (let i = 0, at = 0; i < size; i++) {
      const above = width * ys[2 * i], below = width * ys[2 * i + 1];
      for (let j = 0; j < size; j++) {
        const left = xs[2 * j], right = xs[2 * j + 1];
        const a = 4 * (above + left), b = 4 * (above + right), c = 4 * (below + left), d = 4 * (below + right);
        for (let k = 0; k < 3; k++) pixels[at++] = (data[a + k] + data[b + k] + data[c + k] + data[d + k]) / 4 / 255;
      }
    }
    return pixels;
  };

  /* Histograms of oriented gradients in cells × cells over a box and a margin. */
  const gradients = (photo, box, cells = 10, margin = 0.25) => {
    const size = 3 * cells, pixels = crop(photo, vmcEye.padBox(box, margin), size);
    const counts = new Float64Array(cells * cells * DIRECTIONS);
    for (let y = 0; y < size; y++) {
      const above = 3 * size * Math.max(y - 1, 0), below = 3 * size * Math.min(y + 1, size - 1);
      const here = 3 * size * y, down = (3 * size) / (below - above);
      for (let x = 0; x < size; x++) {
        const left = 3 * Math.max(x - 1, 0), right = 3 * Math.min(x + 1, size - 1), across = 3 / (right - left);
        let most = -1, dx = 0, dy = 0;
        for (let c = 0; c < 3; c++) { // of the three colours, the steepest
          const slopeX = single(single(pixels[here + right + c] - pixels[here + left + c]) * across);
          const slopeY = single(single(pixels[below + 3 * x + c] - pixels[above + 3 * x + c]) * down);
          const steep = single(Math.sqrt(single(single(slopeX * slopeX) + single(slopeY * slopeY))));
          if (steep > most) [most, dx, dy] = [steep, slopeX, slopeY];
        }
        const turns = single(single(Math.atan2(dy, dx)) / TURN), angle = single(turns - Math.floor(turns)) * DIRECTIONS;
        const way = Math.floor(angle), share = single(angle - way), strength = single(Math.sqrt(dx * dx + dy * dy));
        const cell = DIRECTIONS * (Math.floor(y / 3) * cells + Math.floor(x / 3));
        counts[cell + (way % DIRECTIONS)] += single(strength * single(1 - share));
        counts[cell + ((way + 1) % DIRECTIONS)] += single(strength * share);
      }
    }
    const length = Math.sqrt(counts.reduce((sum, count) => sum + count * count, 0)) + 1e-3;
    return counts.map((count) => single(Math.sqrt(single(count / length))));
  };

  return { crop, gradients };
})());
