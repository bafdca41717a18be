/* A matrix, row after row in one list, times a vector. Four rows at a time: their sums need not wait for each other. */
vmcEye.product = (matrix, x) => {
  "use strict";

  const d = x.length, rows = matrix.length / d, sums = new Float64Array(rows);
  for (let row = 0; row < rows; row += 4) {
    const a = row * d, b = a + d, c = b + d, e = c + d;
    let p = 0, q = 0, r = 0, s = 0;
    for (let j = 0; j < d; j++) {
      const value = x[j];
      p += value * matrix[a + j];
      q += value * matrix[b + j];
      r += value * matrix[c + j];
      s += value * matrix[e + j];
    }
    [sums[row], sums[row + 1], sums[row + 2], sums[row + 3]] = [p, q, r, s];
  }
  return sums;
};
