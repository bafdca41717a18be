/* Selective search in the page. It does what vmc_lib.where does (segmentation, appearance, merging), in the same
   order and the same single precision, so that a test holds every label and box to Python's. A photo, RGBA bytes,
   is made ready once; what is returned gives, for a scale k, its segments and how they grow back. */
const vmcSearch = (bytes, width, height) => {
  "use strict";

  const COLOUR_BINS = 25, COLOURS = 3 * COLOUR_BINS, TEXTURE_BINS = 10, TEXTURES = 3 * 8 * TEXTURE_BINS;
  const LINES = [0, 1, 2, 3].map((i) => [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)]);
  const DIRECTIONS = LINES.flatMap(([x, y]) => [[x, y], [-x, -y]]);
  const n = width * height, single = Math.fround;

  /* Planes of hue, saturation and value in 0..1. */
  const planes = [0, 1, 2].map(() => new Float32Array(n)), [hue, saturation, value] = planes, tiny = 2 ** -23;
  for (let i = 0; i < n; i++) {
    const [r, g, b] = [0, 1, 2].map((c) => single(bytes[4 * i + c] / 255));
    const top = Math.max(r, g, b), range = single(top - Math.min(r, g, b));
    const [turn, start] = r === top ? [g - b, g < b ? 360 : 0] : g === top ? [b - r, 120] : [r - g, 240];
    hue[i] = single(single(turn) * single(60 / single(range + tiny)) + start) / 360;
    saturation[i] = range / single(top + tiny);
    value[i] = top;
  }

  /* Which pixels lie (dx, dy) from each pixel. Beyond the picture lies its mirror image. */
  const known = {}, mirrored = (place, side) => Math.max(0, Math.min(Math.abs(place), 2 * side - 2 - place));
  const step = (dx, dy) => (known[[dx, dy]] ??= new Int32Array(n).map((_, i) =>
    mirrored(Math.floor(i / width) + dy, height) * width + mirrored((i % width) + dx, width)));
  const [left, right, above, below] = [step(-1, 0), step(1, 0), step(0, -1), step(0, 1)];

  /* A Gaussian blur; the arrays round every sum to single precision. */
  const blur = (plane, sigma) => {
    const reach = Math.round(8 * sigma + 1) >> 1;
    const bell = Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp((-0.5 * (i - reach) ** 2) / sigma ** 2));
    const total = bell.reduce((sum, x) => sum + x), weights = bell.map((x) => single(x / total));
    const across = new Float32Array(n);
    for (let d = -reach; d <= reach; d++) {
      const from = step(d, 0), weight = weights[reach + d];
      for (let i = 0; i < n; i++) across[i] += plane[from[i]] * weight;
    }
    const both = across.map((x) => x * weights[reach]);
    for (let d = 1; d <= reach; d++) {
      const up = step(0, -d), down = step(0, d), weight = weights[reach + d];
      for (let i = 0; i < n; i++) both[i] += single(across[up[i]] + across[down[i]]) * weight;
    }
    return both;
  };

  /* Edges lead from each pixel to those `away`. To sort them, each is a number of 64 bits: its upper half the weight,
     how far apart the two colours are, whose bits sort as it does; its lower half which edge it is. */
  const away = [1, width, width + 1, width - 1], blurred = planes.map((plane) => blur(plane, 0.8));
  const halves = new Uint32Array(8 * n), weights = new Float32Array(halves.buffer), squared = (x) => single(x * x);
  let length = 0;
  for (let edge = 0; edge < 4 * n; edge++) {
    const a = edge >> 2, b = a + away[edge & 3];
    if (b >= n || Math.abs((a % width) - (b % width)) > 1) continue; // off the picture
    halves[length++] = edge;
    weights[length++] = Math.sqrt(blurred.reduce((sum, p) => single(sum + squared(single(p[a] - p[b]))), 0));
  }
  new BigUint64Array(halves.buffer, 0, length / 2).sort();

  /* The segments of a walk along the edges: each pixel's label. */
  const join = (scale) => {
    const k = scale / 255, tolerance = new Float32Array(n).fill(k), size = new Int32Array(n).fill(1);
    const root = size.map((_, pixel) => pixel);
    const find = (pixel) => {
      while (root[pixel] !== pixel) pixel = root[pixel] = root[root[pixel]];
      return pixel;
    };
    for (const last of [false, true])
      for (let e = 0; e < length; e += 2) {
        const pixel = halves[e] >> 2, weight = weights[e + 1];
        const one = find(pixel), other = find(pixel + away[halves[e] & 3]);
        const a = Math.min(one, other), b = Math.max(one, other);
        const apart = last ? Math.min(size[a], size[b]) >= scale : weight >= Math.min(tolerance[a], tolerance[b]);
        if (a === b || apart) continue;
        root[b] = a;
        size[a] += size[b];
        tolerance[a] = weight + k / size[a];
      }
    let count = 0;
    root.forEach((first, pixel) => (root[pixel] = first === pixel ? count++ : root[first]));
    return root;
  };

  /* Which of some bins each pixel falls into by its `place` among them, counted on from `first`. */
  const binned = (place, bins, first) =>
    new Uint16Array(n).map((_, i) => first + Math.max(0, Math.min(bins - 1, place(i))));
  const colours = (plane, c) => binned((i) => single(plane[i] * COLOUR_BINS), COLOUR_BINS, c * COLOUR_BINS);

  /* For eight directions, the bins of the slopes. */
  const textures = (plane, c) => {
    const smooth = blur(plane, 1), first = COLOURS + c * 8 * TEXTURE_BINS;
    const rise = smooth.map((_, i) => smooth[right[i]] - smooth[left[i]]);
    const mean = smooth.map((x, i) => single(smooth[left[i]] + smooth[right[i]]) + 2 * x);
    const dx = rise.map((x, i) => single(rise[above[i]] + rise[below[i]]) + 2 * x);
    const dy = mean.map((_, i) => mean[below[i]] - mean[above[i]]);
    return DIRECTIONS.map(([x, y], way) =>
      binned((i) => TEXTURE_BINS * (x * dx[i] + y * dy[i]), TEXTURE_BINS, first + way * TEXTURE_BINS));
  };
  const rows = [...planes.map(colours), ...planes.flatMap(textures)];

  const around = (a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];

  /* The labels of the pixels, the two regions of every merge, and the box around every region. */
  return (scale) => {
    const labels = join(scale), regions = [], touching = new Set(), merges = [];
    labels.forEach((label, i) => {
      const x = i % width, y = Math.floor(i / width);
      const region = (regions[label] ??= { size: 0, box: [x, y, x, y], look: new Float32Array(COLOURS + TEXTURES) });
      region.size++;
      region.box = around(region.box, [x, y, x + 1, y + 1]);
      for (const row of rows) region.look[row[i]]++;
      for (const other of [labels[right[i]], labels[below[i]]])
        if (other !== label) touching.add(Math.min(label, other) * n + Math.max(label, other));
    });
    for (const region of regions) // its shares in the bins of colour, and in those of texture
      region.look = region.look.map((pixels, x) => pixels / (region.size * (x < COLOURS ? 3 : 3 * 8)));

    /* Two regions that touch: how large they are together, the box around them, and how alike they are. */
    const meet = (i, j) => {
      const a = regions[i], b = regions[j], size = a.size + b.size, box = around(a.box, b.box);
      const empty = (box[2] - box[0]) * (box[3] - box[1]) - size;
      let like = 0;
      for (let x = 0; x < a.look.length; x++) like += Math.min(a.look[x], b.look[x]);
      return { i, j, size, box, like: like + (1 - size / n) + (1 - empty / n) };
    };

    let pairs = Array.from(touching, (pair) => meet(Math.floor(pair / n), pair % n));
    while (pairs.length) {
      const [{ i, j, size, box }] = pairs.sort((a, b) => b.like - a.like || a.i - b.i || a.j - b.j);
      const a = regions[i], b = regions[j], made = regions.length;
      regions.push({ size, box, look: a.look.map((share, x) => (a.size * share + b.size * b.look[x]) / size) });
      merges.push([i, j]);
      const gone = (one) => one === i || one === j, parted = (pair) => gone(pair.i) || gone(pair.j);
      const others = new Set(pairs.filter(parted).flatMap((pair) => [pair.i, pair.j]));
      pairs = pairs.filter((pair) => !parted(pair));
      for (const other of others) if (!gone(other)) pairs.push(meet(other, made));
    }
    return { labels, merges, boxes: regions.map(({ box }) => box) };
  };
};
