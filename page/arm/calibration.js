/* Off-line calibration, Eq. 6–7 and ours (vmc_lib/cerebellum/offline.py). `reach(weights)` tells
   where the hand is over the hold of a reach. Both rules yield every trial as it is made, the plan's
   own reach first: its weights, where it ended on average, and the mean distance from the target. */
import { distance, dot, mean, minus, plus, sum, times } from "../vectors.js";
import { leastChange } from "./planning.js";

const attempt = (plan, weights, reach) => {
  const hold = reach(weights).map((place) => place.slice(0, plan.target.length));
  const distances = hold.map((place) => distance(plan.target, place));
  return { weights, reached: mean(hold), error: sum(distances) / hold.length };
};

/* Algorithm 1: every n of `gains`, each from the plan's own miss. */
export function* algorithm1(plan, reach, { gains }) {
  const first = attempt(plan, plan.weights, reach);
  yield first;
  for (const n of gains) {
    const change = algorithm1Change(plan, first.reached, n);
    yield { n, ...attempt(plan, plus(plan.weights, change), reach) };
  }
}

/* Eq. 6–7: positions from the shoulder, the error pointing from the hand to the target. */
const algorithm1Change = ({ target, points }, reached, n) => {
  const error = minus(target, reached);
  const [far, from, to] = [error, reached, target].map((v) => Math.hypot(...v));
  return points.map((point) => {
    const towards = minus(point, reached);
    const lengths = far * Math.hypot(...towards);
    const cosine = lengths > 0 ? dot(towards, error) / lengths : 0;
    const away = Math.hypot(...point);
    return (far / from) * (1 + (n * (to - away)) / away) * cosine;
  });
};

/* Ours: Eq. 4 solved for the error, by a Jacobian that every surprise corrects (Broyden). */
export function* broydenCalibration(plan, reach, { trials, largestStep }) {
  let jacobian = plan.target.map((_, axis) => plan.points.map((point) => point[axis]));
  let best = attempt(plan, plan.weights, reach);
  yield best;
  for (let trial = 1; trial <= trials; trial++) {
    const wanted = leastChange(jacobian, minus(plan.target, best.reached));
    const share = Math.min(1, largestStep / Math.max(Math.hypot(...wanted), 1e-12));
    const change = times(share, wanted);
    const tried = attempt(plan, plus(best.weights, change), reach);
    yield tried;
    const shift = minus(tried.reached, best.reached);
    const square = Math.max(dot(change, change), 1e-24);
    jacobian = jacobian.map((row, axis) =>
      plus(row, times((shift[axis] - dot(row, change)) / square, change)));
    if (tried.error < best.error) best = tried;
  }
}
