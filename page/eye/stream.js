/* The ventral stream (vmc_lib/what/stream.py): four stages of 3 × 3 filters, each followed by the strongest of 2 × 2
   neighbours and a threshold; a read-out names a box and refines it. */
Object.assign(vmcEye, (() => {
  "use strict";

  const WIDTH = 48, MARGIN = 0.25;

  /* A box in colour with a margin, less its mean, over its standard deviation: (3, 50, 50), a border of zeros around.
     It is flipped where `along` or `down` is -1. */
  const preprocess = (photo, box, [along, down]) => {
    const pixels = vmcEye.crop(photo, vmcEye.padBox(box, MARGIN), WIDTH), n = pixels.length, wide = WIDTH + 2;
    const mean = pixels.reduce((sum, x) => sum + x, 0) / n;
    const spread = Math.sqrt(pixels.reduce((sum, x) => sum + (x - mean) ** 2, 0) / n) + 0.01;
    const x = new Float64Array(3 * wide * wide);
    for (let i = 0, at = 0; i < WIDTH; i++)
      for (let j = 0; j < WIDTH; j++) {
        const row = down > 0 ? i : WIDTH - 1 - i, column = along > 0 ? j : WIDTH - 1 - j;
        for (let c = 0; c < 3; c++) x[(c * wide + row + 1) * wide + column + 1] = (pixels[at++] - mean) / spread;
      }
    return x;
  };

  /* One stage: maps (channels, size, size) with a border of zeros to maps half as wide, bordered too. Two filters at
     a time see the four places that compete: so their sums stay in the processor's registers. */
  const stage = ({ W, b }, x, size) => {
    const wide = size + 2, half = size / 2, out = half + 2, filters = b.length, terms = W.length / filters;
    const next = new Float64Array(filters * out * out), patch = new Float64Array(4 * terms);
    for (let y = 0; y < half; y++)
      for (let z = 0; z < half; z++) {
        for (let t = 0, row = 2 * y * wide + 2 * z; t < terms; row += wide * (wide - 3))
          for (let i = 0; i < 3; i++, row += wide)
            for (let at = row; at < row + 3; at++, t++) {
              patch[4 * t] = x[at];
              patch[4 * t + 1] = x[at + 1];
              patch[4 * t + 2] = x[at + wide];
              patch[4 * t + 3] = x[at + wide + 1];
            }
        for (let k = 0; k < filters; k += 2) {
          let a0 = 0, a1 = 0, a2 = 0, a3 = 0, b0 = 0, b1 = 0, b2 = 0, b3 = 0;
          for (let t = 0, one = k * terms, two = one + terms; t < terms; t++, one++, two++) {
            const p = patch[4 * t], q = patch[4 * t + 1], r = patch[4 * t + 2], s = patch[4 * t + 3];
            const v = W[one], w = W[two];
            a0 += v * p; a1 += v * q; a2 += v * r; a3 += v * s;
            b0 += w * p; b1 += w * q; b2 += w * r; b3 += w * s;
          }
          const place = (k * out + y + 1) * out + z + 1;
          next[place] = Math.max(0, Math.max(a0, a1, a2, a3) + b[k]);
          next[place + out * out] = Math.max(0, Math.max(b0, b1, b2, b3) + b[k + 1]);
        }
      }
    return next;
  };

  /* Log-odds that a box holds a shuttlecock, and four deltas of it: averaged over flips. */
  const look = ({ stages, readout, offsets }, photo, box, flips) => {
    const outputs = [0, 0, 0, 0, 0];
    for (const flip of flips) {
      let x = preprocess(photo, box, flip), size = WIDTH;
      for (const one of stages) [x, size] = [stage(one, x, size), size / 2];
      const wide = size + 2, d = readout.length / 5, answer = Array.from(offsets);
      for (let t = 0; t < d; t++) {
        const column = t % size, row = Math.floor(t / size), place = row + 1 + 2 * Math.floor(row / size);
        for (let k = 0; k < 5; k++) answer[k] += x[place * wide + column + 1] * readout[k * d + t];
      }
      [1, ...flip, 1, 1].forEach((sign, k) => (outputs[k] += (sign * answer[k]) / flips.length));
    }
    return { logOdds: outputs[0], deltas: outputs.slice(1) };
  };

  return { look };
})());
