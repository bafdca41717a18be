/* The arm in the page. The physics is MuJoCo's own, compiled to WebAssembly and given the library's
   arm26.xml. What vmc_lib adds to it in Python (the muscle, planning, calibration) is said here once
   more, in the same order and by the same names; constants come from Python, in `given`. A test holds
   every number to Python's. Positions are metres, angles radians; nothing here touches the page. */
const vmcArm = (() => {
  "use strict";

  const script = document.currentScript?.src;
  const clip = (x, low, high) => Math.min(Math.max(x, low), high);
  const sum = (values) => values.reduce((total, value) => total + value, 0);
  const dot = (a, b) => sum(a.map((x, i) => x * b[i]));
  const minus = (a, b) => a.map((x, i) => x - b[i]);
  const plus = (a, b) => a.map((x, i) => x + b[i]);
  const times = (factor, a) => a.map((x) => factor * x);

  /* ---- The muscle, Eq. 9–11 (vmc_lib/arm/muscle.py) ---- */

  class Muscle {
    constructor(constants) {
      Object.assign(this, constants);
    }

    activationRate(excitation, activation) {
      const { tauActivation, tauDeactivation } = this;
      const rise = excitation / tauActivation + (1 - excitation) / tauDeactivation;
      const gap = excitation - activation;
      return gap * (gap >= 0 ? rise : 1 / tauDeactivation);
    }

    forceLength(length) {
      const square = (length - 0.95) ** 2;
      return Math.exp(square - 40 * square ** 2);
    }

    forceVelocity(velocity) {
      const inverse = 1 / (1 - clip(velocity, ...this.velocityRange)) ** 2;
      return 1.6 - 1.6 * Math.exp(0.1 * inverse - 1.1 * inverse ** 2);
    }

    passiveForce(length) {
      return 1.3 * Math.atan(0.1 * (Math.max(length, 0.22) - 0.22) ** 10);
    }

    force(activation, length, velocity, maximum) {
      const active = this.forceLength(length) * this.forceVelocity(velocity) * activation;
      return maximum * (active + this.passiveForce(length));
    }
  }

  /* ---- The arm, Eq. 12 (vmc_lib/arm/simulate.py, the engine "mujoco") ---- */

  class Arm {
    constructor(mujoco, given) {
      Object.assign(this, { mujoco, given, muscle: new Muscle(given.muscle) });
      this.model = mujoco.MjModel.from_xml_string(given.xml);
      this.data = new mujoco.MjData(this.model); // steps
      this.seen = new mujoco.MjData(this.model); // is looked at, in any posture
      this.wrist = mujoco.mj_name2id(this.model, mujoco.mjtObj.mjOBJ_SITE.value, "hand");
      this.pull = new Float64Array(given.F0.length); // N, of each muscle in the last step
      this.reset();
    }

    /* At rest in a posture, the muscles' activation as given: by default as every reach begins. */
    reset(posture = this.given.start, activation = this.given.rest) {
      this.mujoco.mj_resetData(this.model, this.data);
      this.state.qpos.set(posture);
      this.pull.fill(0);
      this.activation = Float64Array.from(activation);
    }

    /* Views of MuJoCo's memory: slow to make, and void once another arm has made that memory grow. */
    get state() {
      if (!this.views?.qpos.length) {
        const { qpos, qvel, ten_length, ten_J, qfrc_applied } = this.data;
        this.views = { qpos, qvel, ten_length, ten_J, qfrc_applied };
      }
      return this.views;
    }

    /* One step of 1 ms: the muscles pull as they are active now, and hear `excitation` (6). */
    step(excitation) {
      const { mujoco, model, data, muscle, activation, given } = this;
      const { qpos, qvel, ten_length, ten_J, qfrc_applied } = this.state;
      mujoco.mj_step1(model, data);
      const torque = [0, 1].map((joint) => this.stop(qpos[joint], qvel[joint], joint));
      for (let k = 0; k < activation.length; k++) {
        const [shoulder, elbow] = [ten_J[2 * k], ten_J[2 * k + 1]]; // minus the moment arms
        const stretching = shoulder * qvel[0] + elbow * qvel[1];
        const length = (ten_length[k] - given.slack[k]) / given.L0[k];
        const velocity = stretching / (muscle.maxVelocity * given.L0[k]);
        this.pull[k] = muscle.force(activation[k], length, velocity, given.F0[k]);
        torque[0] -= shoulder * this.pull[k];
        torque[1] -= elbow * this.pull[k];
        activation[k] += given.step * muscle.activationRate(excitation[k], activation[k]);
      }
      qfrc_applied.set(torque);
      mujoco.mj_step2(model, data);
    }

    stop(angle, velocity, joint) {
      const { limits, stop } = this.given;
      const beyond = angle - clip(angle, ...limits[joint]);
      return -stop.stiffness * (beyond + stop.damping * Math.abs(beyond) * velocity);
    }

    /* A movement from rest, as excitations (a list of T times six) ask: every millisecond of it. */
    move(excitations) {
      this.reset();
      const moment = () => ({
        q: [...this.state.qpos], activation: [...this.activation], pull: [...this.pull],
      });
      const motion = [moment()];
      for (const excitation of excitations) {
        this.step(excitation);
        motion.push(moment());
      }
      return motion;
    }

    /* Where everything is in posture q: the joints and the wrist, and each muscle's path. */
    geometry(q) {
      const { model, seen } = this;
      seen.qpos.set(q);
      this.mujoco.mj_forward(model, seen);
      const { xpos, site_xpos, wrap_xpos, ten_wrapadr, ten_wrapnum } = seen;
      const point = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];
      const path = (k) => Array.from({ length: ten_wrapnum[k] }, (_, i) => point(wrap_xpos, ten_wrapadr[k] + i));
      const joints = [point(xpos, 1), point(xpos, 2), point(site_xpos, this.wrist)];
      return { joints, muscles: this.given.muscles.map((_, k) => path(k)) };
    }

    hand(q) {
      return this.geometry(q).joints[2];
    }

    /* The posture that puts the wrist at a place (x, y) of the plane: Newton's method. */
    posture(target) {
      const q = [...this.given.start];
      for (let i = 0; i < 20; i++) {
        const [here, first, second] = [[0, 0], [1e-6, 0], [0, 1e-6]].map((by) => this.hand(plus(q, by)));
        const [a, b] = [minus(first, here), minus(second, here)].map((v) => times(1e6, v));
        const miss = minus(target, here);
        const determinant = a[0] * b[1] - b[0] * a[1];
        q[0] += clip((miss[0] * b[1] - miss[1] * b[0]) / determinant, -0.2, 0.2);
        q[1] += clip((miss[1] * a[0] - miss[0] * a[1]) / determinant, -0.2, 0.2);
      }
      return q;
    }
  }

  /* ---- Habitual planning, Eq. 3–5 (vmc_lib/motor/planning.py) ---- */

  /* Remembered reaches: the points (N, 3) where they ended, and the knots of their excitations. */
  class Library {
    constructor({ points, knots, shape, steps }) {
      const [count, rows, muscles] = shape;
      const bytes = Uint8Array.from(atob(knots), (c) => c.charCodeAt(0));
      const values = new Float32Array(bytes.buffer);
      const at = (n, i, k) => values[(n * rows + i) * muscles + k];
      const fill = (length, make) => Array.from({ length }, (_, i) => make(i));
      this.points = points;
      this.knots = fill(count, (n) => fill(rows, (i) => fill(muscles, (k) => at(n, i, k))));
      this.spline = fill(steps, (t) => basis(t / (steps - 1), rows));
    }

    /* Eq. 3: Σ w_i u_i(t), held to [0, 1]; splines are linear, so their knots may be mixed instead. */
    excitations({ chosen, weights }) {
      const mixed = this.knots[0].map((row, i) =>
        row.map((_, k) => sum(chosen.map((n, j) => weights[j] * this.knots[n][i][k]))));
      return this.spline.map(({ first, values }) =>
        mixed[0].map((_, k) => clip(sum(values.map((v, i) => v * mixed[first + i][k])), 0, 1)));
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
      const [x, y] = minus(point.slice(0, 2), target);
      const quadrant = (Math.floor(Math.atan2(y, x) / (Math.PI / 2)) + 4) % 4;
      const distance = Math.hypot(x, y);
      if (distance < nearest[quadrant].distance) nearest[quadrant] = { row, distance };
    });
    if (nearest.some(({ row }) => row === undefined))
      throw new RangeError("this target is not surrounded by templates; move it inside them");
    return nearest.map(({ row }) => row);
  };

  const plan = (target, library, rule = habitualWeights) => {
    const chosen = surrounding(target, library.points);
    const points = chosen.map((row) => library.points[row].slice(0, 2));
    return { target, chosen, points, weights: rule(target, points) };
  };

  /* ---- Off-line calibration, Eq. 6–7 and ours (vmc_lib/cerebellum/offline.py) ----
     `reach(weights)` tells where a reach ends. Both rules yield every trial as it is made, the plan's
     own reach first: its weights, where it ended, and how far from the target. */

  const attempt = (plan, weights, reach) => {
    const reached = reach(weights);
    return { weights, reached, error: Math.hypot(...minus(plan.target, reached)) };
  };

  /* Algorithm 1: every n of `gains`, each from the plan's own miss. */
  function* published(plan, reach, { gains }) {
    const first = attempt(plan, plan.weights, reach);
    yield first;
    for (const n of gains) {
      const change = publishedChange(plan, first.reached, n);
      yield { n, ...attempt(plan, plus(plan.weights, change), reach) };
    }
  }

  /* Eq. 6–7, positions measured from the shoulder, the error pointing from the hand to the target. */
  const publishedChange = ({ target, points }, reached, n) => {
    const error = minus(target, reached);
    const [far, from, to] = [error, reached, target].map((v) => Math.hypot(...v));
    return points.map((point) => {
      const towards = minus(point, reached);
      const lengths = far * Math.hypot(...towards);
      const cosine = lengths > 0 ? dot(towards, error) / lengths : 0;
      const distance = Math.hypot(...point);
      return (far / from) * (1 + (n * (to - distance)) / distance) * cosine;
    });
  };

  /* Ours: Eq. 4 solved for the error, believing a Jacobian that every surprise corrects (Broyden). */
  function* calibrate(plan, reach, { trials, largestStep }) {
    let jacobian = [0, 1].map((axis) => plan.points.map((point) => point[axis]));
    let best = attempt(plan, plan.weights, reach);
    yield best;
    for (let trial = 1; trial <= trials; trial++) {
      const wanted = leastChange(jacobian, minus(plan.target, best.reached));
      const change = times(Math.min(1, largestStep / Math.max(Math.hypot(...wanted), 1e-12)), wanted);
      const tried = attempt(plan, plus(best.weights, change), reach);
      yield tried;
      const shift = minus(tried.reached, best.reached);
      const square = Math.max(dot(change, change), 1e-24);
      jacobian = jacobian.map((row, axis) =>
        plus(row, times((shift[axis] - dot(row, change)) / square, change)));
      if (tried.error < best.error) best = tried;
    }
  }

  /* ---- Getting MuJoCo from the book's own files, when an arm is first started ---- */

  const fetchMujoco = async () => {
    if (typeof loadMujoco === "undefined")
      await new Promise((resolve, reject) => {
        const tag = document.createElement("script");
        tag.src = new URL("vendor/mujoco.js", script);
        Object.assign(tag, { onload: resolve, onerror: () => reject(new Error(`no ${tag.src}`)) });
        document.head.append(tag);
      });
    const packed = await fetch(`data:application/gzip;base64,${loadMujoco.wasm}`);
    const stream = packed.body.pipeThrough(new DecompressionStream("gzip"));
    const wasmBinary = await new Response(stream).arrayBuffer();
    return loadMujoco({ wasmBinary, locateFile: (name) => name }); // nothing is left to locate
  };

  let loading;
  const load = async (given) => new Arm(await (loading ??= fetchMujoco()), given);

  return {
    Muscle, Library, load, plan, habitualWeights, exactWeights, published, calibrate,
  };
})();
