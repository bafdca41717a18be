/* A shuttlecock followed from one frame of a film to the next: the ventral stream's corrections draw a box back onto
   what has moved in it, or beside it. */
import { hasRightSize, refine } from "./box_selection.js";
import { decodeDeltas, iou } from "./boxes.js";
import { each } from "./pieces.js";

const LOOKS = 3, SETTLED = 0.9; // so often a box is corrected, or until its last correction has this IoU
const ASIDE = [-0.6, 0, 0.6].flatMap((x, _, all) => all.map((y) => [x, y, 0, 0])); // else it is looked for there

/* The box of what was in a box one frame ago; null where nothing of a shuttlecock's looks and size is near. */

export const follow = function* ({ stream, selector }, photo, box, camera) {
  const look = (box) => refine(stream, photo, box);
  const settle = function* (box) {
    for (let n = 1; ; n++) {
      const seen = look(box);
      yield;
      if (n === LOOKS || iou(box, seen.box) > SETTLED) return seen;
      box = seen.box;
    }
  };
  const right = (seen) => seen.logOdds > 0 && hasRightSize(seen.box, camera, selector);
  let best = yield* settle(box);
  if (!right(best)) {
    const around = yield* each(ASIDE.map((deltas) => decodeDeltas(box, deltas)), look);
    best = yield* settle(around.reduce((a, b) => (b.logOdds > a.logOdds ? b : a)).box);
  }
  return right(best) ? best.box : null;
};
