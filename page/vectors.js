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

  /* The solution of a linear system, its matrix symmetric and positive, by elimination. */
  const solve = (matrix, right) => {
    const rows = matrix.map((row, i) => [...row, right[i]]);
    rows.forEach((pivot, i) => rows.slice(i + 1).forEach((row) => {
      const share = row[i] / pivot[i];
      for (let k = i; k < row.length; k++) row[k] -= share * pivot[k];
    }));
    return rows.reduceRight((x, row, i) => [(row.at(-1) - dot(row.slice(i + 1, -1), x)) / row[i], ...x], []);
  };

  return { clip, dot, mean, minus, plus, solve, sum, times };
})();
