/* Selective search in the page. It does what vmc_lib.where does (segmentation, appearance, merging), in
   the same order and the same single precision, so that a test holds every label and box to Python's. */
const vmcSearch = (() => {
  "use strict";

  const single = Math.fround;
  const COLOUR_BINS = 25, COLOURS = 3 * COLOUR_BINS, TEXTURE_BINS = 10, WAYS = [[0, 1], [1, 0], [1, 1], [1, -1]];
  const COS = [0, 1, 2, 3].map((i) => Math.cos((i * Math.PI) / 4));
  const SIN = [0, 1, 2, 3].map((i) => Math.sin((i * Math.PI) / 4));

  /* Planes of hue, saturation and value in 0..1, from RGBA bytes. */
  const hsv = (bytes) => {
    const n = bytes.length / 4, tiny = 2 ** -23;
    const [hue, saturation, value] = [0, 1, 2].map(() => new Float32Array(n));
    for (let i = 0; i < n; i++) {
      const r = single(bytes[4 * i] / 255), g = single(bytes[4 * i + 1] / 255), b = single(bytes[4 * i + 2] / 255);
      const top = Math.max(r, g, b), range = single(top - Math.min(r, g, b));
      const step = single(r === top ? g - b : g === top ? b - r : r - g);
      const start = r === top ? (g < b ? 360 : 0) : g === top ? 120 : 240;
      hue[i] = single(step * single(60 / single(range + tiny)) + start) / 360;
      saturation[i] = range / single(top + tiny);
      value[i] = top;
    }
    return [hue, saturation, value];
  };

  /* Where d steps from each of n places lead: beyond either end, to the mirror image. */
  const steps = (n, d) => Int32Array.from({ length: n }, (_, i) =>
    Math.max(0, Math.min(Math.abs(i + d), 2 * n - 2 - i - d)));

  /* A Gaussian blur; the arrays round every sum to single precision. */
  const blur = (plane, width, height, sigma) => {
    const reach = Math.round(8 * sigma + 1) >> 1;
    const bell = Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp((-0.5 * (i - reach) ** 2) / sigma ** 2));
    const total = bell.reduce((sum, x) => sum + x), weights = bell.map((x) => single(x / total));
    const across = new Float32Array(plane.length), both = new Float32Array(plane.length);
    for (let d = -reach; d <= reach; d++) {
      const to = steps(width, d), weight = weights[reach + d];
      for (let y = 0, i = 0; y < height; y++)
        for (let x = 0; x < width; x++, i++) across[i] += plane[y * width + to[x]] * weight;
    }
    for (let d = 0; d <= reach; d++) {
      const up = steps(height, -d), down = steps(height, d), weight = weights[reach + d];
      for (let y = 0, i = 0; y < height; y++) {
        const one = up[y] * width, other = down[y] * width;
        for (let x = 0; x < width; x++, i++)
          both[i] += (d ? single(across[one + x] + across[other + x]) : across[i]) * weight;
      }
    }
    return both;
  };

  /* How far apart neighbours' colours are, a weight for each edge, and the edges, the lightest first. */
  const edges = (planes, width, height) => {
    const weights = new Float32Array(4 * width * height).fill(Infinity);
    WAYS.forEach(([dy, dx], way) => {
      const far = dy * width + dx;
      for (let y = 0; y < height - dy; y++)
        for (let x = Math.max(0, -dx); x < width - Math.max(0, dx); x++) {
          const i = y * width + x;
          let square = 0;
          for (let c = 0; c < 3; c++) {
            const step = single(planes[c][i] - planes[c][i + far]);
            square = single(square + single(step * step));
          }
          weights[4 * i + way] = Math.sqrt(square);
        }
    });
    /* Read as integers, the bits of such numbers sort alike; behind them, the edge's own number. */
    const bits = new Uint32Array(weights.buffer), keys = new Float64Array(weights.length);
    for (let i = 0; i < keys.length; i++) keys[i] = bits[i] * 2 ** 22 + i;
    const order = Uint32Array.from(keys.sort(), (key) => key % 2 ** 22);
    return { weights, order: order.subarray(0, order.findIndex((edge) => weights[edge] === Infinity)) };
  };

  /* The segments of a walk along the edges: each pixel's label, and how many there are. */
  const join = ({ weights, order }, width, height, scale) => {
    const n = width * height, k = scale / 255, neighbour = [1, width, width + 1, width - 1];
    const root = Int32Array.from({ length: n }, (_, i) => i), size = new Int32Array(n).fill(1);
    const tolerance = new Float32Array(n).fill(k), labels = new Int32Array(n);
    const find = (pixel) => {
      while (root[pixel] !== pixel) pixel = root[pixel] = root[root[pixel]];
      return pixel;
    };
    for (const last of [false, true])
      for (const edge of order) {
        const one = find(edge >>> 2), other = find((edge >>> 2) + neighbour[edge & 3]);
        if (one === other) continue;
        const a = Math.min(one, other), b = Math.max(one, other);
        if (last ? Math.min(size[a], size[b]) >= scale : weights[edge] >= Math.min(tolerance[a], tolerance[b])) continue;
        root[b] = a;
        size[a] += size[b];
        tolerance[a] = weights[edge] + k / size[a];
      }
    let count = 0;
    for (let pixel = 0; pixel < n; pixel++) labels[pixel] = root[pixel] === pixel ? count++ : labels[find(pixel)];
    return { labels, count };
  };

  /* Which of a few bins a value falls into. */
  const bin = (value, bins) => Math.trunc(Math.max(1 - bins, Math.min(bins - 1, value)));

  /* For eight directions, the bin of each pixel's upward slope, counted on from `first`. */
  const textures = (plane, width, height, first) => {
    const smooth = blur(plane, width, height, 1);
    const rows = Array.from({ length: 8 }, (_, r) => new Uint16Array(plane.length).fill(first + r * TEXTURE_BINS));
    const [left, right] = [-1, 1].map((d) => steps(width, d)), [above, below] = [-1, 1].map((d) => steps(height, d));
    for (let y = 0, i = 0; y < height; y++)
      for (let x = 0; x < width; x++, i++) {
        const up = above[y] * width, here = y * width, down = below[y] * width, l = left[x], r = right[x];
        const rise = (row) => single(smooth[row + r] - smooth[row + l]);
        const mean = (row) => single(single(smooth[row + l] + smooth[row + r]) + 2 * smooth[row + x]);
        const dx = single(single(rise(up) + rise(down)) + 2 * rise(here)), dy = single(mean(down) - mean(up));
        for (let way = 0; way < 4; way++) {
          const code = bin(TEXTURE_BINS * (COS[way] * dx + SIN[way] * dy), TEXTURE_BINS);
          rows[2 * way + (code < 0)][i] += Math.abs(code);
        }
      }
    return rows;
  };

  /* A photo, RGBA bytes, made ready once; then `grow(k)` gives its segments and how they grow back:
     labels, their count, the two regions of every merge, and the box around every region. */
  const prepare = (bytes, width, height) => {
    const planes = hsv(bytes), sorted = edges(planes.map((p) => blur(p, width, height, 0.8)), width, height);
    const colours = planes.map((plane, c) =>
      Uint16Array.from(plane, (v) => c * COLOUR_BINS + bin(single(v * COLOUR_BINS), COLOUR_BINS)));
    const rows = planes.flatMap((plane, c) => textures(plane, width, height, COLOURS + c * 8 * TEXTURE_BINS));
    return { grow: (k) => grow(join(sorted, width, height, k), [...colours, ...rows], width, height) };
  };

  /* Of each segment, the shares of its pixels in the bins of colour, and in those of texture. */
  const describe = (rows, labels, size) => {
    const looks = size.map(() => new Float32Array(COLOURS + 3 * 8 * TEXTURE_BINS));
    for (const row of rows) for (let i = 0; i < row.length; i++) looks[labels[i]][row[i]]++;
    return looks.map((look, segment) => look.map((n, x) => n / (size[segment] * (x < COLOURS ? 3 : 3 * 8))));
  };

  const around = (a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];

  const grow = ({ labels, count }, rows, width, height) => {
    const size = Array(count).fill(0), boxes = Array(count).fill([Infinity, Infinity, 0, 0]);
    const touching = new Set(), merges = [];
    for (let y = 0, i = 0; y < height; y++)
      for (let x = 0; x < width; x++, i++) {
        const label = labels[i];
        size[label]++;
        boxes[label] = around(boxes[label], [x, y, x + 1, y + 1]);
        for (const other of [x + 1 < width ? labels[i + 1] : label, y + 1 < height ? labels[i + width] : label])
          if (other !== label) touching.add(Math.min(label, other) * count + Math.max(label, other));
      }
    const looks = describe(rows, labels, size);

    const alike = (i, j) => {
      const [one, other] = [looks[i], looks[j]], both = size[i] + size[j], [x0, y0, x1, y1] = around(boxes[i], boxes[j]);
      let total = 0;
      for (let x = 0; x < one.length; x++) total += Math.min(one[x], other[x]);
      return total + (1 - both / labels.length) + (1 - ((x1 - x0) * (y1 - y0) - both) / labels.length);
    };

    const meet = (i, j) => ({ i, j, like: alike(i, j) });
    const before = (a, b) => (b.like - a.like || a.i - b.i || a.j - b.j) < 0;
    let pairs = Array.from(touching, (pair) => meet(Math.floor(pair / count), pair % count));
    for (let made = count; pairs.length; made++) {
      const { i, j } = pairs.reduce((best, pair) => (before(pair, best) ? pair : best));
      merges.push([i, j]);
      size.push(size[i] + size[j]);
      boxes.push(around(boxes[i], boxes[j]));
      looks.push(looks[i].map((share, x) => (size[i] * share + size[j] * looks[j][x]) / size[made]));
      const gone = (one) => one === i || one === j, parted = (pair) => gone(pair.i) || gone(pair.j);
      const others = new Set(pairs.filter(parted).flatMap((pair) => [pair.i, pair.j]));
      pairs = pairs.filter((pair) => !parted(pair));
      for (const other of others) if (!gone(other)) pairs.push(meet(other, made));
    }
    return { labels, count, merges, boxes, size };
  };

  return { prepare };
})();
