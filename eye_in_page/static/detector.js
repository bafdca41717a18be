/* The object detector for photographs (vmc_lib/where/detector.py): it scores candidates, refines the best round by
   round, predicts their IoU, and keeps few. */
Object.assign(vmcEye, (() => {
  "use strict";

  const EVERY = 8; // boxes a piece

  const squaredNorms = (matrix, d) => {
    const norms = new Float64Array(matrix.length / d);
    for (let i = 0; i < matrix.length; i++) norms[Math.floor(i / d)] += matrix[i] ** 2;
    return norms;
  };

  /* Ridge regression on features and on radial basis functions of them (vmc_lib/where/box_regression.py). */
  const predict = (ridge, features) => {
    const { mean, axes, centres, gamma: [gamma], weights, bias } = ridge, d = mean.length, m = bias.length;
    const x = features.map((feature, i) => feature - mean[i]), z = vmcEye.product(axes, x);
    const [square] = squaredNorms(z, z.length), dots = vmcEye.product(centres, z);
    const squares = (ridge.squares ??= squaredNorms(centres, z.length)), outputs = Float64Array.from(bias);
    for (let i = 0; i < weights.length / m; i++) {
      const value = i < d ? x[i] : Math.exp(-gamma * (square + squares[i - d] - 2 * dots[i - d]));
      for (let k = 0; k < m; k++) outputs[k] += value * weights[i * m + k];
    }
    return outputs;
  };

  /* A linear support vector machine's score of features. */
  const svmScore = ({ support, weights, bias }, features) =>
    features.reduce((sum, x, i) => sum + x * support[i], 0) * weights[0] + bias[0];

  /* The results of a function of each of some boxes, a few a piece. */
  const each = function* (boxes, look) {
    const results = [];
    for (const box of boxes) if (results.push(look(box)) % EVERY === 0) yield;
    return results;
  };

  /* The boxes that pass, those kept, the best first, and their scores. */
  const detect = function* (detector, photo, candidates) {
    const { gate, iouPredictor, overlap, regressions, threshold } = detector;
    const refine = (box) => regressions.reduce((refined, regression) =>
      vmcEye.decodeDeltas(refined, predict(regression, vmcEye.gradients(photo, refined))), box);
    const scores = yield* each(candidates, (box) => svmScore(detector, vmcEye.gradients(photo, box)));
    const refined = yield* each(candidates.filter((_, i) => scores[i] > gate), refine);
    const ious = yield* each(refined, (box) => predict(iouPredictor, vmcEye.gradients(photo, box))[0]);
    const good = (_, i) => ious[i] > threshold, passed = refined.filter(good), fits = ious.filter(good);
    const kept = vmcEye.nms(passed, fits, overlap);
    return { passed, boxes: vmcEye.vote(kept, passed, fits), scores: kept.map((i) => fits[i]) };
  };

  return { detect, predict, svmScore };
})());
