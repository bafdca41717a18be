/* The arm that runs in the page (`live_arm`): its drawing, and two ways to move it. The physics is in
   arm.js; MuJoCo itself is fetched when the reader starts the arm. */
const vmcLive = (() => {
  "use strict";

  const OFTEN = 6; // of so many frames one also moves the plot and the numbers: both are slow to set
  const frame = () => new Promise(requestAnimationFrame);
  const signed = (number, digits) => number.toFixed(digits).replace("-", "−");
  const degrees = (angle) => `${signed((angle * 180) / Math.PI, 1)}°`;
  const millimetres = (metres, digits = 0) => `${signed(1000 * metres, digits)} mm`;

  /* ---- How it is drawn ---- */

  const ball = ([x, y, z], size) => [size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, x, y, z, 1];
  const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];

  /* The transform that lays a unit cylinder (centred, along y) from one point to another. */
  const span = (from, to, radius) => {
    const along = to.map((x, i) => x - from[i]);
    const length = Math.hypot(...along);
    if (length < 1e-9) return ball(from, 1e-6);
    const sizes = along.map(Math.abs);
    const least = sizes.indexOf(Math.min(...sizes));
    const across = cross(along, [0, 1, 2].map((i) => +(i === least)));
    const side = across.map((x) => (radius * x) / Math.hypot(...across));
    const other = cross(side, along.map((x) => x / length));
    const middle = from.map((x, i) => (x + to[i]) / 2);
    return [...side, 0, ...along, 0, ...other, 0, ...middle, 1];
  };

  /* The arm twice: in the scene that vmc_lib.show.arm recorded, and from the side, over a plot. */
  class Drawing {
    constructor(box, given) {
      this.given = given;
      this.balls = []; // where the scene's balls are, or nothing
      this.marks = []; // on the plot: [kind, colour, points in metres, size]
      this.view = vmcScene(box.querySelector(".vmc-scene"));
      this.view.show(given.scene);
      this.plot = box.querySelector("svg[data-axes]");
      const [x0, x1, y0, y1, left, right, bottom, top] = this.plot.dataset.axes.split(" ").map(Number);
      Object.assign(this, { x0, y0, left, bottom });
      Object.assign(this, { wide: (right - left) / (x1 - x0), high: (top - bottom) / (y1 - y0) });
      const { width, height } = this.plot.viewBox.baseVal;
      this.plot.insertAdjacentHTML("beforeend", `<clipPath id="${box.id}-frame"><rect
        x="${left * width}" width="${(right - left) * width}"
        y="${top * height}" height="${(bottom - top) * height}"/></clipPath>
        <g clip-path="url(#${box.id}-frame)"></g>`);
    }

    /* Show the arm's geometry with each muscle's activation and pull; if `brief`, in 3-D alone. */
    show(seen, brief) {
      this.seen = seen;
      this.draw();
      if (brief) return;
      this.plot.lastElementChild.innerHTML =
        [["line", "ink", seen.joints, 5], ...this.marks].map((mark) => this.mark(...mark)).join("");
    }

    /* A viewer that comes back to life shows the scene as recorded: draw once more. */
    refresh() {
      if (this.view.viewer && this.view.viewer !== this.drawn) this.draw();
    }

    draw() {
      const { viewer } = this.view;
      if (viewer !== this.drawn) this.prepare(viewer);
      if (!viewer) return;
      const { joints, muscles, activation, pull } = this.seen;
      const { radius, F0 } = this.given;
      this.bends.count = this.stretches.count = 0;
      this.tube(joints, radius.bone, this.bone);
      muscles.forEach((line, k) => {
        const share = Math.min(Math.max(pull[k] / F0[k], 0), 1);
        const heat = this.cold.clone().lerp(this.hot, activation[k]);
        this.tube(line, radius.thin + (radius.thick - radius.thin) * share, heat);
      });
      for (const mesh of [this.bends, this.stretches])
        mesh.instanceMatrix.needsUpdate = mesh.instanceColor.needsUpdate = true;
      viewer.set_transform(["meshcat", "arm", "hand"], ball(joints[2], 1));
      this.balls.forEach((position, i) => {
        viewer.set_property(["meshcat", `ball${i}`], "visible", Boolean(position));
        if (position) viewer.set_transform(["meshcat", `ball${i}`], ball(position, 1));
      });
      viewer.set_dirty();
    }

    /* In place of the recorded tubes, two meshes of many instances: they are quick to move. */
    prepare(viewer) {
      this.drawn = viewer;
      if (!viewer) return;
      const { THREE } = self.MeshCat;
      const [bone, cold, hot] = this.given.colours.map((hex) => new THREE.Color(hex));
      const add = (shape) => {
        const mesh = new THREE.InstancedMesh(shape, new THREE.MeshLambertMaterial(), 100);
        mesh.frustumCulled = false;
        viewer.scene_tree.find(["meshcat", "live"]).object.add(mesh);
        return mesh;
      };
      const bends = add(new THREE.SphereGeometry(1, 10, 8));
      const stretches = add(new THREE.CylinderGeometry(1, 1, 1, 10));
      Object.assign(this, { bone, cold, hot, bends, stretches, matrix: new THREE.Matrix4() });
      for (const name of ["bones", ...this.given.muscles])
        viewer.set_property(["meshcat", "arm", name], "visible", false);
    }

    tube(line, radius, colour) {
      const put = (mesh, transform) => {
        mesh.setMatrixAt(mesh.count, this.matrix.fromArray(transform));
        mesh.setColorAt(mesh.count++, colour);
      };
      line.forEach((point, i) => {
        put(this.bends, ball(point, radius));
        if (i) put(this.stretches, span(line[i - 1], point, radius));
      });
    }

    mark(kind, colour, points, size) {
      const { width, height } = this.plot.viewBox.baseVal;
      const put = ([x, y]) => [
        (width * (this.left + this.wide * (x - this.x0))).toFixed(1),
        (height * (this.bottom + this.high * (y - this.y0))).toFixed(1),
      ];
      const paint = `var(--vmc-${colour})`;
      if (kind === "line")
        return `<polyline points="${points.map(put).join(" ")}" fill="none" stroke="${paint}"
          stroke-width="${size}" stroke-opacity=".7" stroke-linecap="round"/>`;
      const [x, y] = put(points);
      const look = kind === "ring" ? `fill="none" stroke-width="2" stroke` : "fill";
      return `<circle cx="${x}" cy="${y}" r="${size}" ${look}="${paint}"/>`;
    }

    /* The place in the plane that the reader points at. */
    pointed({ clientX, clientY }) {
      const { left, top, width, height } = this.plot.getBoundingClientRect();
      return [
        this.x0 + ((clientX - left) / width - this.left) / this.wide,
        this.y0 + ((clientY - top) / height - this.bottom) / this.high,
      ];
    }
  }

  /* ---- What both ways to move it share ---- */

  class Live {
    constructor(box) {
      this.box = box;
      this.given = JSON.parse(box.querySelector("script").textContent);
      this.drawing = new Drawing(box, this.given);
      this.calm = matchMedia("(prefers-reduced-motion: reduce)");
      this.form = box.querySelector("form");
      this.controls = this.form.querySelector("fieldset"); // closed until the arm is started
      this.form.append(vmcScene.turner(this.drawing.view));
      this.form.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook would take it
      this.form.elements.main.addEventListener("click", () => (this.arm ? this.main() : this.load()));
      box.dataset.ready = "";
    }

    async load() {
      if (this.loading) return;
      this.loading = true;
      this.say("Loading the physics …");
      await frame();
      try {
        const arm = await vmcArm.load(this.given);
        await this.drawing.view.awake();
        this.arm = arm;
      } catch (error) {
        return this.say(`This browser cannot run the arm: ${error.message ?? error}`);
      }
      for (const element of this.form.elements) element.disabled = false;
      const keep = () => (this.drawing.refresh(), requestAnimationFrame(keep));
      this.ready();
      keep();
    }

    /* Show one moment of a movement, { q, activation, pull }; if `brief`, in the scene alone. */
    show(moment, brief = false) {
      const seen = { ...this.arm.geometry(moment.q), ...moment };
      this.drawing.show(seen, brief);
      const [forward, up, right] = seen.joints[2];
      if (!brief) this.tell({
        shoulder: degrees(moment.q[0]), elbow: degrees(moment.q[1]),
        forward: millimetres(forward), up: millimetres(up), right: millimetres(right),
      });
      return seen.joints[2];
    }

    tell(values) {
      for (const [name, text] of Object.entries(values))
        this.box.querySelector(`[data-tell="${name}"]`).textContent = text;
    }

    say(words) {
      const flat = this.arm && !this.drawing.view.viewer;
      const note = flat ? " (This browser draws no 3-D picture: watch the side view.)" : "";
      this.box.querySelector("[role=status]").textContent = words + note;
    }

    label(words) {
      this.form.elements.main.textContent = words;
    }
  }

  /* ---- The bench: six excitations in the reader's hand ---- */

  class Bench extends Live {
    ready() {
      this.sliders = [...this.controls.querySelectorAll("input")];
      this.controls.addEventListener("input", () => this.hear());
      this.form.elements.step.addEventListener("click", () => this.advance(10));
      this.form.elements.reset.addEventListener("click", () => this.reset());
      new IntersectionObserver(([entry]) => (this.inSight = entry.isIntersecting)).observe(this.box);
      this.reset();
      this.main();
    }

    hear() {
      this.excitation = this.sliders.map((slider) => +slider.value);
      for (const slider of this.sliders) slider.nextElementSibling.textContent = (+slider.value).toFixed(2);
    }

    reset() {
      for (const slider of this.sliders) slider.value = slider.defaultValue;
      this.hear();
      this.arm.reset(this.given.start, this.excitation);
      this.time = 0;
      this.trail = [];
      this.advance(0);
      this.say("Back at the start.");
    }

    /* Let that many milliseconds pass, and show where the arm is then. */
    advance(steps, brief = false) {
      for (let i = 0; i < steps; i++) this.arm.step(this.excitation);
      this.time += steps;
      this.drawing.marks = [["line", "orange", this.trail, 2]];
      this.trail.push(this.show({
        q: [...this.arm.state.qpos], activation: this.arm.activation, pull: this.arm.pull,
      }, brief));
      this.trail = this.trail.slice(-300);
      if (!brief) this.tell({ time: `${(this.time / 1000).toFixed(2)} s` });
    }

    /* Run in real time, or pause; who wants less motion sees two pictures a second. */
    async main() {
      const turn = (this.turn = this.turn ? null : {});
      this.label(turn ? "Pause" : "Go on");
      this.advance(0);
      if (!turn) {
        const [shoulder, elbow] = [...this.arm.state.qpos].map(degrees);
        const time = (this.time / 1000).toFixed(2);
        return this.say(`Paused at ${time} s. Shoulder ${shoulder}, elbow ${elbow}.`);
      }
      this.say("The arm is running.");
      const pace = this.calm.matches ? 500 : 0; // ms between two pictures
      for (let last = await frame(), now, n = 0; (now = await frame()), turn === this.turn; ) {
        if (now - last < pace) continue;
        const steps = Math.round(Math.min(now - last, Math.max(pace, 50)));
        if (this.inSight !== false) this.advance(steps, !pace && n++ % OFTEN > 0);
        last = now;
      }
    }
  }

  /* ---- The reach: the reader sets a target; the page plans, moves, misses, calibrates ---- */

  class Reach extends Live {
    ready() {
      this.library = new vmcArm.Library(this.given.library);
      this.form.elements.calibrate.addEventListener("click", () => this.calibrate());
      this.controls.addEventListener("input", () => this.aim());
      const point = (event) => {
        const finger = event.pointerType === "touch"; // it taps, for dragging scrolls the page
        if (finger ? event.type !== "click" : !event.buttons) return;
        event.preventDefault(); // no text is selected on the way
        const { forward, up } = this.form.elements;
        [forward.value, up.value] = this.drawing.pointed(event);
        this.aim();
      };
      for (const type of ["pointerdown", "pointermove", "click"])
        this.drawing.plot.addEventListener(type, point);
      this.label("Reach");
      this.aim();
    }

    /* Take the target from the sliders and plan anew; what was under way ends. */
    aim() {
      this.turn = {}; // whose turn it is: whoever waited for a frame looks whether it is still his
      const { forward, up, rule, weights } = this.form.elements;
      for (const slider of [forward, up])
        slider.nextElementSibling.textContent = `${signed(+slider.value, 3)} m`;
      Object.assign(this, { target: [+forward.value, +up.value], rule: rule.value, plan: null });
      Object.assign(this, { goal: null, planned: null, calibrated: null });
      this.tell({ planned: "–", calibrated: "–", weights: "–", tries: "–" });
      try {
        this.plan = vmcArm.plan(this.target, this.library, vmcArm[weights.value]);
        this.goal = this.arm.hand(this.arm.posture(this.target));
        this.say("A target is set: let the arm reach for it.");
      } catch (error) {
        this.say(`Nothing planned: ${error.message}`);
      }
      this.mark([]);
      const { start, rest } = this.given;
      this.show({ q: start, activation: rest, pull: rest.map(() => 0) });
    }

    /* Everything on the plot and in the scene but the arm: target, templates, ends, the hand's path. */
    mark(path) {
      const { plan, target, planned, calibrated } = this;
      const shown = (calibrated ?? planned)?.weights ?? plan?.weights;
      const threads = plan?.points.map((p, i) => ["line", "blue", [target, p], 8 * Math.abs(shown[i])]);
      const ends = [[planned, "red"], [calibrated, "purple"]].filter(([trial]) => trial);
      this.drawing.marks = [
        ...(threads ?? []),
        ["line", "orange", path, 2],
        ["ring", "green", target, 7],
        ...ends.map(([trial, colour]) => ["dot", colour, trial.reached, 4]),
      ];
      this.drawing.balls = [this.goal, planned?.hand, calibrated?.hand];
    }

    motion(weights) {
      return this.arm.move(this.library.excitations({ ...this.plan, weights }));
    }

    ended(weights) {
      return this.arm.hand(this.motion(weights).at(-1).q).slice(0, 2);
    }

    /* Play a movement in its own time; `trial` is then known as `name`. */
    async play(name, trial, turn) {
      const motion = this.motion(trial.weights);
      const path = motion.filter((_, t) => t % 10 === 0).map(({ q }) => this.arm.hand(q));
      const start = await frame();
      for (let n = 0, t = this.calm.matches ? motion.length : 0; t < motion.length - 1; n++) {
        this.mark(path.slice(0, 1 + t / 10));
        this.show(motion[t], n % OFTEN > 0);
        t = Math.max(0, Math.round((await frame()) - start));
        if (turn !== this.turn) return false;
      }
      this[name] = { ...trial, hand: path.at(-1) };
      this.mark(path);
      this.show(motion.at(-1));
      this.tell({
        [name]: millimetres(trial.error, 1),
        weights: trial.weights.map((w) => signed(w, 2)).join(", "),
      });
      return true;
    }

    /* The habitual reach. */
    async main() {
      const turn = (this.turn = {});
      if (!this.plan) return;
      Object.assign(this, { planned: null, calibrated: null });
      this.tell({ calibrated: "–", tries: "–" });
      const { plan } = this;
      const [first] = vmcArm.published(plan, (weights) => this.ended(weights), { gains: [] });
      if (!(await this.play("planned", first, turn))) return;
      this.say(`The planned reach stopped ${millimetres(first.error, 1)} from the target.`);
    }

    /* Try off-line, as fast as the page can; then move once more, with the best weights. */
    async calibrate() {
      if (!this.planned) await this.main();
      if (!this.planned) return;
      const turn = (this.turn = {});
      this.say("Trying off-line …");
      const trials = [];
      for (const trial of vmcArm[this.rule](this.plan, (w) => this.ended(w), this.given.calibration)) {
        trials.push(trial);
        this.tell({ tries: `${trials.length - 1}` });
        await frame();
        if (turn !== this.turn) return;
      }
      const best = trials.reduce((a, b) => (b.error < a.error ? b : a));
      if (!(await this.play("calibrated", best, turn))) return;
      const which = best.n === undefined ? "" : ` (n = ${best.n})`;
      this.say(
        `After ${trials.length - 1} tries the best${which} stops ${millimetres(best.error, 1)} from the ` +
        `target; the planned reach missed by ${millimetres(this.planned.error, 1)}.`
      );
    }
  }

  /* In the page every arm starts by itself; a live kernel's widget brings its `page` along. */
  const kinds = { bench: Bench, reach: Reach };
  const start = (box) => new kinds[box.dataset.mode](box);
  const startAll = () => document.querySelectorAll(".vmc-live:not([data-ready])").forEach(start);
  if (document.readyState === "loading") addEventListener("DOMContentLoaded", startAll);
  else startAll();
  return (el, page) => {
    el.innerHTML = page;
    const { view } = start(el.firstElementChild).drawing;
    return () => view.viewer && view.stop();
  };
})();
