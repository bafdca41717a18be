/* Where the arm is in a posture: its bodies, the wrist, and each muscle's path and belly. A scene
   carries what it needs of the model (vmc_lib/show/anatomy.py). Nothing here touches the page;
   positions are metres in the shoulder frame before the trunk turns, angles radians. */
const vmcAnatomy = (() => {
  "use strict";

  const RINGS = 36; // cross-sections of a muscle and its tendons
  const TENDON = 0.0026; // m, radius
  const LONGER = 1.45; // a belly than its fibres: they lie side by side, one beginning after another

  const mix = (a, b, share) => a.map((x, i) => x + share * (b[i] - x));
  const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

  /* Rotation matrix, row by row, about a unit axis. */
  const rotation = ([x, y, z], angle) => {
    const [s, c] = [Math.sin(angle), Math.cos(angle)];
    const t = 1 - c;
    return [
      [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
      [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
      [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
    ];
  };
  const apply = (rows, v) => rows.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
  const multiply = (a, b) =>
    a.map((row) => [0, 1, 2].map((j) => row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]));

  class Anatomy {
    constructor(given) {
      Object.assign(this, given);
    }

    /* The frames of trunk, humerus and forearm: { rows, origin } turn a body's points into ours. */
    frames(q) {
      const frames = [{ rows: rotation([1, 0, 0], 0), origin: [0, 0, 0] }];
      this.joints.forEach(({ at, axis }, i) => {
        const { rows } = frames[i];
        frames.push({ rows: multiply(rows, rotation(axis, q[i])), origin: this.placed(frames[i], at) });
      });
      return frames;
    }

    placed({ rows, origin }, point) {
      return apply(rows, point).map((x, i) => x + origin[i]);
    }

    /* The wrist, when the trunk has turned. */
    wrist(q, turn = 0) {
      const [x, y, z] = this.placed(this.frames(q)[2], this.hand);
      const [ox, oz] = this.trunk;
      const [c, s] = [Math.cos(turn), Math.sin(turn)];
      return [ox + c * (x - ox) + s * (z - oz), y, oz + c * (z - oz) - s * (x - ox)];
    }

    /* Each muscle's points from origin to insertion; a point may glide as one joint turns. */
    paths(q, frames = this.frames(q)) {
      return this.muscles.map(({ path }) =>
        path.map(({ on, joint = 0, at }) => {
          const [low, high] = this.limits[joint];
          const place = Math.min(Math.max((q[joint] - low) / (high - low), 0), 1) * (at.length - 1);
          const row = Math.min(Math.floor(place), Math.max(at.length - 2, 0));
          const point = at.length > 1 ? mix(at[row], at[row + 1], place - row) : at[0];
          return this.placed(frames[on], point);
        }));
    }

    /* A muscle as rings along its path: centres, radii (m), and which share is flesh, not tendon.
       The belly is as long as the fibres are now; its volume stays, so it swells as they shorten. */
    belly(path, { slack, volume, before }) {
      const along = [0];
      for (let i = 1; i < path.length; i++) along.push(along[i - 1] + distance(path[i], path[i - 1]));
      const whole = along.at(-1);
      const fibres = Math.max(whole - slack, 0.02) * LONGER;
      const first = before * (whole - fibres);
      const thickest = Math.sqrt(volume / (0.5 * Math.PI * fibres)); // of a sine, squared: mean 1/2
      let [centres, piece] = [[], 1];
      for (let i = 0; i < RINGS; i++) {
        const s = (whole * i) / (RINGS - 1);
        while (piece < path.length - 1 && along[piece] < s) piece++;
        const step = along[piece] - along[piece - 1];
        centres.push(mix(path[piece - 1], path[piece], step ? (s - along[piece - 1]) / step : 0));
      }
      for (let pass = 0; pass < 4; pass++) // the corners of the path are rounded
        centres = centres.map((c, i) =>
          i && i < RINGS - 1 ? mix(c, mix(centres[i - 1], centres[i + 1], 0.5), 0.5) : c);
      const radii = [], flesh = [];
      for (let i = 0; i < RINGS; i++) {
        const share = ((whole * i) / (RINGS - 1) - first) / fibres;
        const inside = share > 0 && share < 1 ? Math.sin(Math.PI * share) : 0;
        radii.push(Math.max(TENDON, thickest * inside));
        flesh.push(Math.min(1, 3 * inside));
      }
      return { centres, radii, flesh };
    }
  }

  /* A movement { name: samples } at a place between two samples: each mixed. */
  const moment = (motion, place) => {
    const [row, share] = [Math.floor(place), place % 1];
    const mixed = Object.entries(motion).map(([name, samples]) => {
      const [a, b] = [samples[row], samples[Math.min(row + 1, samples.length - 1)]];
      return [name, Array.isArray(a) ? mix(a, b, share) : a + share * (b - a)];
    });
    return Object.fromEntries(mixed);
  };

  return { Anatomy, RINGS, distance, mix, moment, multiply, rotation };
})();
