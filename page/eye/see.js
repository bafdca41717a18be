/* Both visual pathways: what is seen of a photo, and in what words (vmc_lib/loop.py). */
import { filterBySize, select } from "./box_selection.js";
import { detect } from "./detector.js";
import { inPieces } from "./pieces.js";
import { propose } from "./selective_search.js";

export const percent = (p) => `${(100 * p).toFixed(0)} %`;
export const countWords = (count, thing, plural = "s") => `${count} ${thing}${count === 1 ? "" : plural}`;

/* The result of both pathways: boxes, the likeliest first, and their probability of holding a shuttlecock. */
export class Sight {
  constructor({ boxes, probability }, minProbability) {
    Object.assign(this, { boxes, probability, minProbability });
  }

  /* The boxes that count as shuttlecocks, the best first. */
  get shuttlecocks() {
    return this.boxes.filter((_, i) => this.probability[i] > this.minProbability);
  }

  /* The best of them, or null. */
  get box() {
    return this.shuttlecocks[0] ?? null;
  }

  /* One line that describes the result. */
  get summary() {
    const { probability } = this, sure = probability.slice(0, this.shuttlecocks.length).map(percent);
    if (sure.length) return `${sure.length > 1 ? `${sure.length} shuttlecocks` : "a shuttlecock"}, ${sure.join(", ")} sure`;
    if (!probability.length) return "nothing that looks like an object";
    return `no shuttlecock; likeliest of ${countWords(probability.length, "box", "es")}: ${percent(Math.max(...probability))}`;
  }
}

const sight = function* (brain, photo, camera, report) {
  const { detector, lab, selector } = brain;
  const candidates = yield* propose(photo, detector.strategy, lab, (boxes) => report("candidates", { boxes }));
  let detections = yield* detect(detector, photo, candidates);
  report("kept", detections);
  if (camera) detections = filterBySize(detections, camera, selector);
  const ratio = camera ? selector.ratio : 1;
  const selected = yield* select(brain, photo, detections, ratio, (names) => report("names", names));
  const result = new Sight(selected, selector.minProbability);
  report("sight", result);
  return result;
};

/* A promise of the Sight of a photo { data, width, height }, four bytes a pixel, 600 × 400. `report(stage, data)`
   tells of each stage as soon as it is known: the "candidates" so far, the boxes and scores "kept", of any size, the
   boxes and probability that the first look "names", the "sight" after more looks. */
export const see = (brain, photo, { camera = null, report = () => {} } = {}) =>
  inPieces(sight(brain, photo, camera, report));
