/* The object detector for photographs (vmc_lib/where/detector.py): it scores candidates, refines the best round by
   round, predicts their IoU, and keeps few. */
Object.assign(vmcEye, (() => {
  "use strict";

  const { each } = vmcEye, EVERY = 8; // boxes a piece

  /* Ridge regression on features and on radial basis functions of them (vmc_lib/where/box_regression.py). */
  const predict = (ridge, features) => {
    const { mean, axes, centres, squares, gamma: [gamma], weights, bias } = ridge;
    const x = features.map((feature, i) => feature - mean[i]), z = vmcEye.product(axes, x);
    const basis = vmcEye.radialBasis(gamma, z, vmcVectors.dot(z, z), centres, squares);
    return vmcEye.addProduct(bias, [...x, ...basis], weights);
  };

  /* A linear support vector machine's score of features. */
  const svmScore = ({ support, weights, bias }, features) =>
    features.reduce((sum, x, i) => sum + x * support[i], 0) * weights[0] + bias[0];

  /* The boxes that pass, those kept, the best first, and their scores. */
  const detect = function* (detector, photo, candidates) {
    const { gate, iouPredictor, overlap, regressions, threshold } = detector;
    const refine = (box) => regressions.reduce((refined, regression) =>
      vmcEye.decodeDeltas(refined, predict(regression, vmcEye.gradients(photo, refined))), box);
    const scores = yield* each(candidates, (box) => svmScore(detector, vmcEye.gradients(photo, box)), EVERY);
    const refined = yield* each(candidates.filter((_, i) => scores[i] > gate), refine, EVERY);
    const ious = yield* each(refined, (box) => predict(iouPredictor, vmcEye.gradients(photo, box))[0], EVERY);
    const good = (_, i) => ious[i] > threshold, passed = refined.filter(good), fits = ious.filter(good);
    const kept = vmcEye.nms(passed, fits, overlap);
    return { passed, boxes: vmcEye.vote(kept, passed, fits), scores: kept.map((i) => fits[i]) };
  };

  return { detect, predict, svmScore };
})());
