/* Graph-based segmentation of three planes (vmc_lib/where/segmentation.py; Felzenszwalb and Huttenlocher 2004). */
Object.assign(vmcEye, (() => {
  "use strict";

  const single = Math.fround;

  /* All edges from pixels to four of their neighbours, 4 * pixel + direction, sorted by weight: how far apart two
     colours are. */
  const sortedEdges = function* (planes, width, height) {
    const blurred = [], offsets = [1, width, width + 1, width - 1];
    for (const plane of planes) {
      blurred.push(vmcEye.blur(plane, width, height, 0.8));
      yield;
    }
    const [first, second, third] = blurred, edges = new Uint32Array(4 * first.length);
    const weights = new Float32Array(edges.length);
    let count = 0;
    for (let y = 0, a = 0; y < height; y++)
      for (let x = 0; x < width; x++, a++)
        for (let way = 0; way < 4; way++) {
          if ((way && y + 1 === height) || (way === 3 ? !x : way !== 1 && x + 1 === width)) continue; // off the picture
          const b = a + offsets[way];
          const p = single(first[a] - first[b]), q = single(second[a] - second[b]), r = single(third[a] - third[b]);
          edges[count] = 4 * a + way;
          weights[count++] = Math.sqrt(single(single(single(p * p) + single(q * q)) + single(r * r)));
        }
    yield;
    return { offsets, ...(yield* sortByWeight(edges.subarray(0, count), new Uint32Array(weights.buffer, 0, count))) };
  };

  /* A radix sort: the bits of positive numbers sort like the numbers, eleven of them at a time. */
  const sortByWeight = function* (edges, bits) {
    let [toEdges, toBits] = [new Uint32Array(edges.length), new Uint32Array(edges.length)];
    for (const shift of [0, 11, 22]) {
      const place = new Uint32Array(2049); // where the next with a digit goes
      for (let i = 0; i < bits.length; i++) place[((bits[i] >>> shift) & 2047) + 1]++;
      for (let digit = 1; digit < 2048; digit++) place[digit] += place[digit - 1];
      for (let i = 0; i < bits.length; i++) {
        const to = place[(bits[i] >>> shift) & 2047]++;
        toEdges[to] = edges[i];
        toBits[to] = bits[i];
      }
      [edges, bits, toEdges, toBits] = [toEdges, toBits, edges, bits];
      yield;
    }
    return { edges, weights: new Float32Array(bits.buffer, 0, bits.length) };
  };

  /* The pixels' labels, in the order of each segment's first pixel. An edge merges two segments if its weight is
     within the tolerance of both; of the others, at last, those with a segment smaller than `scale`. */
  const mergeSegments = function* ({ edges, weights, offsets }, pixels, scale) {
    const k = scale / 255, tolerance = new Float32Array(pixels).fill(k), size = new Int32Array(pixels).fill(1);
    const root = Int32Array.from(size, (_, pixel) => pixel), rejected = new Uint32Array(edges.length);
    const find = (pixel) => {
      while (root[pixel] !== pixel) pixel = root[pixel] = root[root[pixel]];
      return pixel;
    };
    const unite = (a, b) => {
      const [first, second] = [Math.min(a, b), Math.max(a, b)];
      size[first] += size[second];
      return (root[second] = first);
    };
    let left = 0, count = 0;
    for (let e = 0; e < edges.length; e++) {
      const edge = edges[e], a = find(edge >> 2), b = find((edge >> 2) + offsets[edge & 3]), weight = weights[e];
      if (a === b) continue;
      if (weight >= Math.min(tolerance[a], tolerance[b])) rejected[left++] = edge;
      else {
        const one = unite(a, b);
        tolerance[one] = weight + k / size[one];
      }
    }
    yield;
    for (const edge of rejected.subarray(0, left)) {
      const a = find(edge >> 2), b = find((edge >> 2) + offsets[edge & 3]);
      if (a !== b && Math.min(size[a], size[b]) < scale) unite(a, b);
    }
    root.forEach((first, pixel) => (root[pixel] = first === pixel ? count++ : root[first]));
    return { labels: root, count };
  };

  return { mergeSegments, sortedEdges };
})());
