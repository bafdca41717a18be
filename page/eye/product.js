/* Products of vectors with matrices, row after row in one list, and what regressions make of them. */
Object.assign(vmcEye, (() => {
  "use strict";

  /* A matrix times a vector. Four rows at a time: their sums need not wait for each other. */
  const product = (matrix, x) => {
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

  /* A vector times a matrix, added to what there is. */
  const addProduct = (there, x, matrix) => {
    const sums = Float64Array.from(there), m = sums.length;
    for (let i = 0; i < x.length; i++) for (let k = 0; k < m; k++) sums[k] += x[i] * matrix[i * m + k];
    return sums;
  };

  /* Radial basis functions of a vector: all squared lengths, its own and the centres', are known. */
  const radialBasis = (gamma, x, square, centres, squares) =>
    product(centres, x).map((dot, i) => Math.exp(-gamma * (square + squares[i] - 2 * dot)));

  return { addProduct, product, radialBasis };
})());
