/* Filters of a plane of numbers in single precision, as OpenCV has them. Beyond an edge lies the mirror image. */
Object.assign(vmcEye, (() => {
  "use strict";

  const single = Math.fround;

  /* Where each place along a side is found, from `reach` before its start to `reach` behind its end. */
  const mirrored = (side, reach) => Int32Array.from({ length: side + 2 * reach }, (_, i) =>
    Math.max(0, Math.min(Math.abs(i - reach), 2 * side - 2 - (i - reach))));

  /* A Gaussian blur of a plane; its arrays round every sum. */
  const blur = (plane, width, height, sigma) => {
    const reach = Math.round(8 * sigma + 1) >> 1, columns = mirrored(width, reach), rows = mirrored(height, reach);
    const bell = Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp((-0.5 * (i - reach) ** 2) / sigma ** 2));
    const total = bell.reduce((sum, x) => sum + x), weights = Float32Array.from(bell, (x) => x / total);
    const across = new Float32Array(plane.length), both = new Float32Array(plane.length);
    for (let y = 0, at = 0; y < height; y++, at += width)
      for (let d = 0; d <= 2 * reach; d++)
        for (let x = 0; x < width; x++) across[at + x] += plane[at + columns[x + d]] * weights[d];
    for (let y = 0, at = 0; y < height; y++, at += width) {
      for (let x = 0; x < width; x++) both[at + x] = across[at + x] * weights[reach];
      for (let d = 1; d <= reach; d++) {
        const up = rows[y + reach - d] * width, down = rows[y + reach + d] * width, weight = weights[reach + d];
        for (let x = 0; x < width; x++) both[at + x] += single(across[up + x] + across[down + x]) * weight;
      }
    }
    return both;
  };

  /* The slopes of a plane along x and y: Sobel's. */
  const sobel = (plane, width, height) => {
    const columns = mirrored(width, 1), rows = mirrored(height, 1);
    const [rise, mean, dx, dy] = Array.from({ length: 4 }, () => new Float32Array(plane.length));
    for (let y = 0, i = 0; y < height; y++)
      for (let x = 0; x < width; x++, i++) {
        const left = plane[y * width + columns[x]], right = plane[y * width + columns[x + 2]];
        rise[i] = right - left;
        mean[i] = single(left + right) + 2 * plane[i];
      }
    for (let y = 0, i = 0; y < height; y++)
      for (let x = 0; x < width; x++, i++) {
        const above = rows[y] * width + x, below = rows[y + 2] * width + x;
        dx[i] = single(rise[above] + rise[below]) + 2 * rise[i];
        dy[i] = mean[below] - mean[above];
      }
    return [dx, dy];
  };

  return { blur, sobel };
})());
