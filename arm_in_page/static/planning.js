/* Habitual planning, Eq. 3–5 (vmc_lib/motor/planning.py). */
const vmcPlanning = (() => {
  "use strict";

  const { dot, minus, plus, sum, times } = vmcVectors;

  /* Eq. 5: by nearness; a target on a template gives that template all the weight. */
  const habitualWeights = (target, points) => {
    const distance = points.map((point) => Math.hypot(...minus(point, target)));
    const on = distance.some((d) => d < 1e-9);
    const nearness = distance.map((d) => (on ? +(d < 1e-9) : 1 / d));
    return times(1 / sum(nearness), nearness);
  };

  /* Eq. 4: Σ w_i p_i = p_t and Σ w_i = 1, as near to Eq. 5 as may be. */
  const exactWeights = (target, points) => {
    const habit = habitualWeights(target, points);
    const columns = [0, 1].map((axis) => points.map((point) => point[axis]));
    return plus(habit, leastChange(columns, minus(target, columns.map((x) => dot(habit, x)))));
  };

  /* The smallest Δw with Σ Δw = 0 that shifts the hand by `shift`; `jacobian` is two rows of N. */
  const leastChange = (jacobian, shift) => {
    const [x, y] = jacobian.map((row) => row.map((value) => value - sum(row) / row.length));
    const [xx, xy, yy] = [dot(x, x), dot(x, y), dot(y, y)];
    const [middle, half] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, xy)];
    if (middle - half < 1e-12 * (middle + half))
      throw new RangeError("the templates lie on one line; choose templates around the target");
    const determinant = xx * yy - xy * xy;
    const a = (yy * shift[0] - xy * shift[1]) / determinant;
    const b = (xx * shift[1] - xy * shift[0]) / determinant;
    return x.map((value, i) => a * value + b * y[i]);
  };

  /* The nearest template in each quadrant round the target. */
  const surrounding = (target, points) => {
    const nearest = [0, 1, 2, 3].map(() => ({ distance: Infinity }));
    points.forEach((point, row) => {
      const [x, y] = minus(point, target);
      const quadrant = (Math.floor(Math.atan2(y, x) / (Math.PI / 2)) + 4) % 4;
      const distance = Math.hypot(x, y);
      if (distance < nearest[quadrant].distance) nearest[quadrant] = { row, distance };
    });
    if (nearest.some(({ row }) => row === undefined))
      throw new RangeError("this target is not surrounded by templates; move it inside them");
    return nearest.map(({ row }) => row);
  };

  /* A reach to `target` with the four templates that surround it. */
  const plan = (target, templateSet, rule = habitualWeights) => {
    const chosen = surrounding(target, templateSet.points);
    const points = chosen.map((row) => templateSet.points[row]);
    return { target, chosen, points, weights: rule(target, points) };
  };

  return { exactWeights, habitualWeights, leastChange, plan };
})();
