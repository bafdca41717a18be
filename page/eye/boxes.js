/* Bounding boxes [x0, y0, x1, y1] (vmc_lib/boxes.py). */
Object.assign(vmcEye, (() => {
  "use strict";

  const area = ([x0, y0, x1, y1]) => (x1 - x0) * (y1 - y0);

  /* Intersection over union; 0 for two boxes without area. */
  const iou = (a, b) => {
    const width = Math.min(a[2], b[2]) - Math.max(a[0], b[0]), height = Math.min(a[3], b[3]) - Math.max(a[1], b[1]);
    const shared = Math.max(0, width) * Math.max(0, height), union = area(a) + area(b) - shared;
    return union > 0 ? shared / union : 0;
  };

  /* The places of numbers in a list, the largest first, equal ones in their order. */
  const falling = (numbers) => Array.from(numbers, (_, i) => i).sort((a, b) => numbers[b] - numbers[a]);

  /* Greedy non-maximum suppression: the places of the boxes kept, the best first. */
  const nms = (boxes, scores, overlap = 0.3) => {
    const kept = [];
    for (const i of falling(scores)) if (kept.every((best) => iou(boxes[best], boxes[i]) <= overlap)) kept.push(i);
    return kept;
  };

  /* Box voting: each of the boxes `kept` becomes a weighted mean of boxes near it that it outscores. */
  const vote = (kept, boxes, scores, temperature = 0.1) => kept.map((best) => {
    const total = [0, 0, 0, 0];
    let weights = 0;
    boxes.forEach((box, i) => {
      const lag = scores[best] - scores[i];
      if (i !== best && (lag < 0 || iou(boxes[best], box) < 0.5)) return;
      const weight = Math.exp(-lag / temperature);
      weights += weight;
      box.forEach((edge, k) => (total[k] += weight * edge));
    });
    return total.map((edge) => edge / weights);
  });

  /* A box with a margin on each side, given as a share of its sides. */
  const padBox = ([x0, y0, x1, y1], margin) => {
    const x = margin * (x1 - x0), y = margin * (y1 - y0);
    return [x0 - x, y0 - y, x1 + x, y1 + y];
  };

  /* A box moved (in shares of its sides) and stretched (by logarithms) by four deltas. */
  const decodeDeltas = ([x0, y0, x1, y1], [right, down, wider, higher]) => {
    const width = x1 - x0, height = y1 - y0;
    const x = (x0 + x1) / 2 + right * width, y = (y0 + y1) / 2 + down * height;
    const halfWidth = (width * Math.exp(wider)) / 2, halfHeight = (height * Math.exp(higher)) / 2;
    return [x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight];
  };

  return { decodeDeltas, falling, iou, nms, padBox, vote };
})());
