/* The object detector for photographs (vmc_lib/where/detector.py): it scores candidates, refines the best round by
   round, predicts their IoU, and keeps few. */
import { dot } from "../vectors.js";
import { decodeDeltas, nms, vote } from "./boxes.js";
import { gradients } from "./features.js";
import { each } from "./pieces.js";
import { addProduct, product, radialBasis } from "./product.js";

const EVERY = 8; // boxes a piece

/* Ridge regression on features and on radial basis functions of them (vmc_lib/where/box_regression.py). */
export const predict = (ridge, features) => {
  const { mean, axes, centres, squares, gamma: [gamma], weights, bias } = ridge;
  const x = features.map((feature, i) => feature - mean[i]), z = product(axes, x);
  const basis = radialBasis(gamma, z, dot(z, z), centres, squares);
  return addProduct(bias, [...x, ...basis], weights);
};

/* A linear support vector machine's score of features. */
export const svmScore = ({ support, weights, bias }, features) =>
  features.reduce((sum, x, i) => sum + x * support[i], 0) * weights[0] + bias[0];

/* The boxes that pass, those kept, the best first, and their scores. */
export const detect = function* (detector, photo, candidates) {
  const { gate, iouPredictor, overlap, regressions, threshold } = detector;
  const refine = (box) => regressions.reduce((refined, regression) =>
    decodeDeltas(refined, predict(regression, gradients(photo, refined))), box);
  const scores = yield* each(candidates, (box) => svmScore(detector, gradients(photo, box)), EVERY);
  const refined = yield* each(candidates.filter((_, i) => scores[i] > gate), refine, EVERY);
  const ious = yield* each(refined, (box) => predict(iouPredictor, gradients(photo, box))[0], EVERY);
  const good = (_, i) => ious[i] > threshold, passed = refined.filter(good), fits = ious.filter(good);
  const kept = nms(passed, fits, overlap);
  return { passed, boxes: vote(kept, passed, fits), scores: kept.map((i) => fits[i]) };
};
