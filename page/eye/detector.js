/* The object detector for photographs (vmc_lib/where/detector.py): it scores candidates, and keeps those that pass. */
import { argsortFalling } from "./boxes.js";
import { gradients } from "./features.js";
import { each } from "./pieces.js";

const EVERY = 8; // boxes a piece

/* A linear support vector machine's score of features. */
export const svmScore = ({ support, weights, bias }, features) =>
  features.reduce((sum, x, i) => sum + x * support[i], 0) * weights[0] + bias[0];

/* Sliding windows over an image: squares a third of a side apart, cut at its edges. */
const windowGrid = ({ width, height }, sides) =>
  sides.flatMap((side) => {
    const starts = (size) => {
      const count = Math.ceil((size + 1 - (2 / 3) * side) / (side / 3));
      return Array.from({ length: count }, (_, i) => (side / 3) * i - side / 6);
    };
    const ends = (start, size) => [Math.max(start, 0), Math.min(start + side, size)];
    return starts(height).flatMap((y) =>
      starts(width).map((x) => {
        const [[x0, x1], [y0, y1]] = [ends(x, width), ends(y, height)];
        return [x0, y0, x1, y1];
      }),
    );
  });

/* The boxes kept, the best first: the candidates that score above the gate, and all windows. */
export const detect = function* (detector, photo, candidates) {
  const boxes = [...candidates, ...windowGrid(photo, detector.windows)];
  const scores = yield* each(boxes, (box) => svmScore(detector, gradients(photo, box)), EVERY);
  const passes = (i) => scores[i] > detector.gate || i >= candidates.length;
  return { boxes: argsortFalling(scores).filter(passes).map((i) => boxes[i]) };
};
