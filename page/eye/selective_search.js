/* Selective search (vmc_lib/where/selective_search.py): the most similar neighbours merge, again and again; every
   region on the way gives a box. All as in Python, in the same order and the same single precision. */
Object.assign(vmcEye, (() => {
  "use strict";

  /* What the segmentations of a photo share: its edges and bins in a colour space. */
  const prepare = function* (photo, space, labGrid) {
    const { width, height } = photo, planes = vmcEye.colourSpaces[space](photo, labGrid);
    yield;
    const edges = yield* vmcEye.sortedEdges(planes, width, height);
    return { width, edges, rows: yield* vmcEye.binPixels(planes, width, height) };
  };

  /* The segments at a scale: the pixels' labels, the regions, and the pairs of them that touch. */
  const segment = function* ({ width, edges, rows }, scale) {
    const { labels, count } = yield* vmcEye.mergeSegments(edges, rows[0].length, scale), touching = new Set();
    yield;
    const meet = (a, b) => a === b || touching.add(Math.min(a, b) * count + Math.max(a, b));
    for (let i = 0; i < labels.length; i++) {
      if ((i + 1) % width) meet(labels[i], labels[i + 1]);
      if (i + width < labels.length) meet(labels[i], labels[i + width]);
    }
    const pairs = Array.from(touching, (pair) => [Math.floor(pair / count), pair % count]);
    yield;
    return { labels, pairs, regions: yield* vmcEye.describe(labels, count, rows, width) };
  };

  /* Hierarchical grouping: the two regions of every merge, and the box around every region. */
  const grow = ({ labels, pairs, regions }, measures) => {
    const all = [...regions], merges = [];
    const meet = (i, j) => ({ i, j, like: vmcEye.similarity(all[i], all[j], measures, labels.length) });
    const nearer = (a, b) => (b.like - a.like || a.i - b.i || a.j - b.j) <= 0 ? a : b;
    let waiting = pairs.map(([i, j]) => meet(i, j));
    while (waiting.length) {
      const { i, j } = waiting.reduce(nearer), union = all.push(vmcEye.mergeRegions(all[i], all[j])) - 1;
      merges.push([i, j]);
      const others = new Set(), rest = [];
      for (const pair of waiting) {
        const first = pair.i === i || pair.i === j, second = pair.j === i || pair.j === j;
        if (!first && !second) rest.push(pair);
        else if (!first || !second) others.add(first ? pair.j : pair.i);
      }
      waiting = rest;
      for (const other of others) waiting.push(meet(other, union));
    }
    return { merges, boxes: all.map(({ box }) => box) };
  };

  /* Object candidates: the boxes of several hierarchies, none twice and no side under `smallest` pixels. After each
     hierarchy it reports all boxes so far. */
  const propose = function* (photo, { colours, k, similarities }, labGrid, report = () => {}, smallest = 20) {
    const boxes = new Map();
    for (const space of colours) {
      const prepared = yield* prepare(photo, space, labGrid);
      for (const scale of k) {
        const segments = yield* segment(prepared, scale);
        for (const measures of similarities) {
          yield;
          for (const box of grow(segments, measures).boxes)
            if (box[2] - box[0] >= smallest && box[3] - box[1] >= smallest) boxes.set(box.join(), box);
          report([...boxes.values()]);
        }
      }
    }
    return [...boxes.values()];
  };

  return { grow, prepare, propose, segment };
})());
