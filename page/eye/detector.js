/* The object detector for photographs (vmc_lib/where/detector.py): it scores candidates, and keeps those that pass. */
import { falling } from "./boxes.js";
import { gradients } from "./features.js";
import { each } from "./pieces.js";

const EVERY = 8; // boxes a piece

/* A linear support vector machine's score of features. */
export const svmScore = ({ support, weights, bias }, features) =>
  features.reduce((sum, x, i) => sum + x * support[i], 0) * weights[0] + bias[0];

/* The boxes kept, the best first. */
export const detect = function* (detector, photo, candidates) {
  const scores = yield* each(candidates, (box) => svmScore(detector, gradients(photo, box)), EVERY);
  return { boxes: falling(scores).filter((i) => scores[i] > detector.gate).map((i) => candidates[i]) };
};
