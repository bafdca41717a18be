/* Habitual planning, Eq. 3–5 (vmc_lib/motor/planning.py). */
import { distance, dot, minus, plus, sum, times } from "../vectors.js";

/* Eq. 5: by nearness; a target on a template gives that template all the weight. */
export const habitualWeights = (target, points) => {
  const distances = points.map((point) => distance(point, target));
  const on = distances.some((d) => d < 1e-9);
  const nearness = distances.map((d) => (on ? +(d < 1e-9) : 1 / d));
  return times(1 / sum(nearness), nearness);
};

/* Eq. 4: Σ w_i p_i = p_t and Σ w_i = 1, as near to Eq. 5 as may be. */
export const exactWeights = (target, points) => {
  const habit = habitualWeights(target, points);
  const columns = target.map((_, axis) => points.map((point) => point[axis]));
  return plus(habit, leastChange(columns, minus(target, columns.map((x) => dot(habit, x)))));
};

/* The smallest Δw with Σ Δw = 0 that shifts the hand by `shift`; `jacobian` is a row of N for each
   axis, made orthogonal one after the other (Gram and Schmidt). */
export const leastChange = (jacobian, shift) => {
  const centred = jacobian.map((row) => row.map((value) => value - sum(row) / row.length));
  const units = [];
  return centred.reduce((change, row, axis) => {
    const rest = units.reduce((left, unit) => minus(left, times(dot(left, unit), unit)), row);
    const length = Math.hypot(...rest);
    if (length <= 1e-6 * Math.hypot(...centred.flat()))
      throw new RangeError("the templates lie on one line, or in space in one plane; choose templates around the target");
    units.push(times(1 / length, rest));
    return plus(change, times((shift[axis] - dot(row, change)) / length, units[axis]));
  }, centred[0].map(() => 0));
};

const quadrant = ([x, y]) => (Math.floor(Math.atan2(y, x) / (Math.PI / 2)) + 4) % 4;
const octant = ([x, y, z]) => (x >= 0) + 2 * (y >= 0) + 4 * (z >= 0); // vmc_lib/motor/planning.py

/* The nearest template in each quadrant round the target; in space, in each octant. */
const surrounding = (target, points, without) => {
  const part = target.length > 2 ? octant : quadrant;
  const nearest = Array.from({ length: 2 ** target.length }, () => ({ far: Infinity }));
  points.forEach((point, row) => {
    if (without.has(row)) return;
    const away = minus(point, target);
    const [here, far] = [part(away), Math.hypot(...away)];
    if (far < nearest[here].far) nearest[here] = { row, far };
  });
  if (nearest.some(({ row }) => row === undefined))
    throw new RangeError("this target is not surrounded by templates; move it inside them");
  return nearest.map(({ row }) => row);
};

/* A reach to `target` with the templates that surround it: four, in space eight; `without` some rows. */
export const plan = (target, templateSet, rule = habitualWeights, without = new Set()) => {
  const chosen = surrounding(target, templateSet.points, without);
  const points = chosen.map((row) => templateSet.points[row]);
  return { target, chosen, points, weights: rule(target, points) };
};
