/* Past experience: reaches that ended where they should (vmc_lib/motor/templates.py). */
import { clip, sum } from "../vectors.js";
import { unzip } from "../vendored.js";

/* N remembered reaches: where they ended, and their excitations; given as knots of splines, or
   themselves. */
class TemplateSet {
  constructor({ points, shape, steps }, values) {
    const [, rows, muscles] = shape;
    const at = (n, i, k) => values[(n * rows + i) * muscles + k];
    const fill = (length, make) => Array.from({ length }, (_, i) => make(i));
    const spline = fill(steps, (t) =>
      rows === steps ? { first: t, values: [1] } : basis(t / (steps - 1), rows));
    this.points = [...points];
    this.commands = []; // of the rows that a plan has asked for, or that were added
    this.expand = (n) => spline.map(({ first, values: share }) =>
      fill(muscles, (k) => sum(share.map((v, i) => v * at(n, first + i, k)))));
  }

  /* One more, that ended at a point. */
  add(point, excitations) {
    this.commands[this.points.length] = excitations;
    this.points.push(point);
  }

  /* The first so many alone. */
  shorten(length) {
    this.points.length = this.commands.length = length;
  }

  /* Eq. 3: Σ w_i u_i(t), held to [0, 1]. */
  excitations({ chosen, weights }) {
    const mixed = chosen.map((n) => (this.commands[n] ??= this.expand(n)));
    return mixed[0].map((now, t) =>
      now.map((_, k) => clip(sum(mixed.map((commands, j) => weights[j] * commands[t][k])), 0, 1)));
  }
}

/* The four cubic B-splines of `rows` that are not zero at x in [0, 1]: de Boor's recursion. */
const basis = (x, rows) => {
  const edge = (i) => clip((i - 3) / (rows - 3), 0, 1);
  let place = 3;
  while (place < rows - 1 && x >= edge(place + 1)) place++;
  const values = [1];
  for (let degree = 1; degree <= 3; degree++) {
    let carried = 0;
    for (let i = 0; i < degree; i++) {
      const [low, high] = [edge(place + 1 + i - degree), edge(place + 1 + i)];
      const share = values[i] / (high - low);
      values[i] = carried + (high - x) * share;
      carried = (x - low) * share;
    }
    values.push(carried);
  }
  return { first: place - 3, values };
};

export const load = async (given) =>
  new TemplateSet(given, new Float32Array(await unzip(given.knots).arrayBuffer()));
