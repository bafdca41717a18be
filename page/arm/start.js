/* What a reader moves an arm by, each in its mode. */
import { Bench } from "./bench.js";
import { ByHand } from "./by_hand.js";
import { Experience } from "./experience.js";
import { Aimed } from "./reach.js";

const MODES = { bench: Bench, reach: Aimed, weights: ByHand, templates: Experience };

export const start = (box) => {
  const live = new MODES[box.dataset.mode](box);
  return () => live.end();
};

/* In the page every arm starts by itself. */
export const startAll = () => document.querySelectorAll(".vmc-live:not([data-ready])").forEach(start);
