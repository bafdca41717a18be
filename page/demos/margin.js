/* A support vector machine between two clouds of points, of which the reader drags one
   (book/figures/regions.py, margin_plot). */
import { sum } from "../vectors.js";

const EXACT = 1e-6, MOST = 100_000; // what the conditions of an optimum may lack; steps
const CELLS = 45; // from one side of the plane to the other, in which the border is sought

/* K(a, b) of points; γ as scikit-learn's "scale". */
const kernelOf = (name, points) => {
  const all = points.flat(), mean = sum(all) / all.length;
  const gamma = all.length / (2 * sum(all.map((value) => (value - mean) ** 2)));
  return name === "linear" ? ([a, b], [c, d]) => a * c + b * d
    : ([a, b], [c, d]) => Math.exp(-gamma * ((a - c) ** 2 + (b - d) ** 2));
};

/* Sequential minimal optimisation: α of each point and the offset b. The pair that is farthest from
   the optimum moves, until none is far. */
const optimise = (points, labels, cost, kernel) => {
  const K = points.map((a) => points.map((b) => kernel(a, b)));
  const alpha = labels.map(() => 0), error = labels.map((y) => -y); // of f without b
  const [low, high] = [1e-12, 1 - 1e-12].map((share) => share * cost); // at its end, but for rounding
  for (let step = 0; ; step++) {
    let [i, j] = [-1, -1];
    for (let k = 0; k < labels.length; k++) {
      const [more, less] = labels[k] > 0 ? [alpha[k] < high, alpha[k] > low] : [alpha[k] > low, alpha[k] < high];
      if (more && (i < 0 || error[k] < error[i])) i = k;
      if (less && (j < 0 || error[k] > error[j])) j = k;
    }
    const gap = error[j] - error[i];
    if (gap < EXACT || step === MOST) return { alpha, bias: -(error[i] + error[j]) / 2 };
    const room = (k, up) => (up ? cost - alpha[k] : alpha[k]);
    const curve = Math.max(K[i][i] + K[j][j] - 2 * K[i][j], 1e-12);
    const move = Math.min(gap / curve, room(i, labels[i] > 0), room(j, labels[j] < 0));
    alpha[i] += labels[i] * move;
    alpha[j] -= labels[j] * move;
    for (let k = 0; k < error.length; k++) error[k] += move * (K[i][k] - K[j][k]);
  }
};

/* Where f, known along `line` in both directions, has a value: pieces of a line, cell by cell (marching
   squares). */
const contour = (f, line, value, put) => {
  let path = "";
  for (let i = 0; i < CELLS; i++)
    for (let j = 0; j < CELLS; j++) {
      const above = (f[i][j] > value) + (f[i + 1][j] > value) + (f[i + 1][j + 1] > value) + (f[i][j + 1] > value);
      if (above % 4 === 0) continue;
      const ring = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]], cuts = [];
      ring.forEach((one, k) => {
        const other = ring[(k + 1) % 4], [low, high] = [one, other].map(([x, y]) => f[x][y] - value);
        if (low > 0 === high > 0) return;
        const share = low / (low - high);
        cuts.push(put(one.map((n, axis) => line[n] + share * (line[other[axis]] - line[n]))).map((n) => n.toFixed(1)));
      });
      for (let k = 0; k + 1 < cuts.length; k += 2) path += `M${cuts[k]}L${cuts[k + 1]}`;
    }
  return path;
};

const fit = (points, labels, cost, name) => {
  const kernel = kernelOf(name, points), { alpha, bias } = optimise(points, labels, cost, kernel);
  const held = points.flatMap((point, k) => (alpha[k] ? [[point, labels[k] * alpha[k]]] : []));
  const score = (x) => {
    let total = bias;
    for (const [point, weight] of held) total += weight * kernel(point, x);
    return total;
  };
  return { alpha, score };
};

export const margin = ({ clouds, labels, plane: [low, high] }, [cost, name, x, y], [plot]) => {
  const points = [[x, y], ...clouds.slice(1)], { alpha, score } = fit(points, labels, cost, name);
  const line = Array.from({ length: CELLS + 1 }, (_, k) => low + ((high - low) * k) / CELLS);
  const f = line.map((across) => line.map((up) => score([across, up])));
  const border = (value, look = "") =>
    `<path d="${contour(f, line, value, plot.place)}" fill="none" stroke="var(--vmc-grey)" stroke-width="1.5"${look}/>`;
  const dashed = ' stroke-dasharray="3 9"'; // a dash in each cell
  const example = (point, k) => {
    if (labels[k] > 0) return plot.mark("dot", "blue", point, 3);
    const [left, top] = plot.place(point).map((middle) => (middle - 3).toFixed(1));
    return `<rect x="${left}" y="${top}" width="6" height="6" fill="var(--vmc-orange)"/>`;
  };
  const shares = alpha.map((a) => a / cost), held = points.filter((_, k) => shares[k] > 1e-6);
  const ring = (point) => plot.mark("ring", "red", point, (Math.sqrt(40 + 160 * shares[points.indexOf(point)]) / 2).toFixed(2));
  const words = `${held.length} rings; yours: α = ${shares[0].toFixed(2)} C`;
  return [
    `Two clouds and a border between them; C is ${+cost.toPrecision(6)}, ${name}: ${words}.`,
    border(-1, dashed) + border(0) + border(1, dashed) + points.map(example).join("") + held.map(ring).join("") +
      plot.mark("words", "ink", plot.head, words, 6),
  ];
};

Object.assign(margin, { fit, between: true });
