/* Arithmetic on short lists of numbers. */
const vmcVectors = (() => {
  "use strict";

  const clip = (x, low, high) => Math.min(Math.max(x, low), high);
  const sum = (values) => values.reduce((total, value) => total + value, 0);
  const dot = (a, b) => sum(a.map((x, i) => x * b[i]));
  const minus = (a, b) => a.map((x, i) => x - b[i]);
  const plus = (a, b) => a.map((x, i) => x + b[i]);
  const mean = (vectors) => times(1 / vectors.length, vectors.reduce(plus));
  const times = (factor, a) => a.map((x) => factor * x);

  return { clip, dot, mean, minus, plus, sum, times };
})();
