/* What segments look like (vmc_lib/where/appearance.py): histograms of colours and of slopes in eight directions. */
Object.assign(vmcEye, (() => {
  "use strict";

  const COLOUR_BINS = 25, SLOPE_BINS = 10, COLOURS = 3 * COLOUR_BINS, BINS = COLOURS + 3 * 8 * SLOPE_BINS;
  const LINES = [0, 1, 2, 3].map((i) => [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)]);
  const single = Math.fround;

  /* The bin of every pixel in every row of bins: three rows of colours, and of slopes one for each plane and line,
     rising in its first half. */
  const binPixels = function* (planes, width, height) {
    const rows = planes.map((plane, c) => {
      const row = new Uint16Array(plane.length), first = c * COLOUR_BINS;
      for (let i = 0; i < row.length; i++)
        row[i] = first + Math.max(0, Math.min(single(plane[i] * COLOUR_BINS), COLOUR_BINS - 1));
      return row;
    });
    yield;
    let first = COLOURS;
    for (const plane of planes) {
      const [dx, dy] = vmcEye.sobel(vmcEye.blur(plane, width, height, 1), width, height);
      yield;
      for (const [x, y] of LINES) {
        const row = new Uint16Array(plane.length);
        for (let i = 0; i < row.length; i++) {
          const slope = x * dx[i] + y * dy[i];
          row[i] = first + Math.min(SLOPE_BINS * Math.abs(slope), SLOPE_BINS - 1) + (slope < 0 && SLOPE_BINS);
        }
        rows.push(row);
        first += 2 * SLOPE_BINS;
      }
      yield;
    }
    return rows;
  };

  /* Of `count` labelled segments the size, the box around, and the look: the shares of its pixels in each bin. */
  const describe = function* (labels, count, rows, width) {
    const counts = new Int32Array(count * BINS), size = new Int32Array(count);
    for (const row of rows) for (let i = 0; i < row.length; i++) counts[labels[i] * BINS + row[i]]++;
    yield;
    const boxes = Array.from(size, () => [width, Infinity, 0, 0]);
    for (let i = 0, x = 0, y = 0; i < labels.length; i++) {
      const box = boxes[labels[i]];
      size[labels[i]]++;
      if (x < box[0]) box[0] = x;
      if (y < box[1]) box[1] = y;
      if (x >= box[2]) box[2] = x + 1;
      box[3] = y + 1;
      if (++x === width) [x, y] = [0, y + 1];
    }
    return boxes.map((box, label) => {
      const look = Float32Array.from(counts.subarray(label * BINS, (label + 1) * BINS));
      for (let row = COLOURS; row < BINS; row += 2 * SLOPE_BINS) { // falling one way is rising the other
        const [rising, falling] = [0, SLOPE_BINS].map((way) => look.subarray(row + way, row + way + SLOPE_BINS));
        const [up, down] = [rising, falling].map((way) => way.reduce((sum, pixels) => sum + pixels));
        rising[0] += down;
        falling[0] += up;
      }
      return { size: size[label], box, look: look.map((n, x) => n / (size[label] * (x < COLOURS ? 3 : 24))) };
    });
  };

  const around = (a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];

  /* The union of two regions, from what is known of both. */
  const mergeRegions = (a, b) => {
    const size = a.size + b.size;
    const look = a.look.map((share, x) => (a.size * share + b.size * b.look[x]) / size);
    return { size, box: around(a.box, b.box), look };
  };

  /* Similarity of two regions of a photo of so many pixels, by those measures that are true. */
  const similarity = (a, b, [byColour, byTexture, bySize, byFill], pixels) => {
    const size = a.size + b.size, [x0, y0, x1, y1] = around(a.box, b.box), [one, other] = [a.look, b.look];
    let total = 0;
    for (let x = byColour ? 0 : COLOURS, end = byTexture ? BINS : COLOURS; x < end; x++)
      total += Math.min(one[x], other[x]);
    if (bySize) total += 1 - size / pixels;
    if (byFill) total += 1 - ((x1 - x0) * (y1 - y0) - size) / pixels;
    return total;
  };

  return { binPixels, describe, mergeRegions, similarity };
})());
