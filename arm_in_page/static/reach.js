/* The reach: the reader sets a target; the page plans, moves, misses, calibrates. */
const vmcReach = (() => {
  "use strict";

  const { Live, OFTEN, frame, millimetres, signed } = vmcLive;
  const { mean, minus, sum } = vmcVectors;

  class Reach extends Live {
    async ready() {
      this.templateSet = await vmcTemplates.load(this.given.templateSet);
      this.form.elements.calibrate.addEventListener("click", () => this.calibrate());
      this.controls.addEventListener("input", () => this.aim());
      this.sliders = [...this.controls.querySelectorAll("input[type=range]")];
      this.handles = this.drawing.plots.map(({ axes }, nth) => {
        const put = vmcHandle(this.box.querySelector(".vmc-pictures"), (place) => {
          axes.forEach((axis, i) => (this.sliders[axis].value = place[i]));
          this.aim();
        }, nth);
        return (place) => put(axes.map((axis) => place[axis]));
      });
      this.label("Reach");
      this.aim();
    }

    /* Take the target from the sliders and plan anew; what was under way ends. */
    aim() {
      this.turn = {}; // whose turn it is: whoever waited for a frame looks whether it is still his
      const { rule, weights } = this.form.elements;
      for (const slider of this.sliders)
        slider.nextElementSibling.textContent = `${signed(+slider.value, 3)} m`;
      const target = this.sliders.map((slider) => +slider.value);
      Object.assign(this, { target, rule: rule.value, plan: null });
      Object.assign(this, { goal: null, planned: null, calibrated: null });
      this.tell({ planned: "–", calibrated: "–", weights: "–", tries: "–", speed: "–" });
      try {
        this.plan = vmcPlanning.plan(this.target, this.templateSet, vmcPlanning[weights.value]);
        this.goal = this.arm.place(this.target);
        this.say("A target is set: let the arm reach for it.");
      } catch (error) {
        this.say(`Nothing planned: ${error.message}`);
      }
      this.mark([]);
      for (const put of this.handles) put(this.target);
      const { start, rest } = this.given;
      this.show({ q: start, activation: rest });
    }

    /* All on the plot and in the scene but the arm: target, templates, ends, the hand's path. */
    mark(path) {
      const { plan, target, planned, calibrated } = this;
      const shown = (calibrated ?? planned)?.weights ?? plan?.weights;
      const width = (i) => 8 * Math.abs(shown[i]);
      const threads = plan?.points.map((p, i) => ["line", "blue", [target, p], width(i)]);
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
      return this.arm.reach(this.templateSet.excitations({ ...this.plan, weights }));
    }

    endPoint(weights) {
      return mean(this.arm.hold(this.motion(weights))).slice(0, this.target.length);
    }

    /* Play a movement in its own time; `trial` is then known as `name`. */
    async play(name, trial, turn) {
      const motion = this.motion(trial.weights);
      const step = 1000 * this.given.step; // ms
      const every = Math.ceil(10 / step); // of its moments the path has one
      const path = motion.filter((_, t) => t % every === 0).map(({ q }) => this.arm.hand(q));
      const start = await frame();
      for (let n = 0, t = this.calm.matches ? motion.length : 0; t < motion.length - 1; n++) {
        this.mark(path.slice(0, 1 + t / every));
        this.show(motion[t], n % OFTEN > 0);
        t = Math.max(0, Math.round(((await frame()) - start) / step));
        if (turn !== this.turn) return false;
      }
      const hold = this.arm.hold(motion);
      const way = sum(hold.slice(1).map((place, t) => Math.hypot(...minus(place, hold[t]))));
      const speed = `${millimetres(way / (this.given.held * this.given.step))}/s`;
      this[name] = { ...trial, hand: mean(hold), speed };
      this.mark(path);
      this.show(motion.at(-1));
      this.tell({
        [name]: millimetres(trial.error, 1),
        speed,
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
      const reach = (weights) => this.endPoint(weights);
      const [first] = vmcCalibration.algorithm1(this.plan, reach, { gains: [] });
      if (!(await this.play("planned", first, turn))) return;
      this.say(
        `The planned reach misses by ${millimetres(first.error, 1)}, on average over the hold; ` +
        `there the hand still moves at ${this.planned.speed}.`
      );
    }

    /* Try off-line, as fast as the page can; then move once more, with the best weights. */
    async calibrate() {
      if (!this.planned) await this.main();
      if (!this.planned) return;
      const turn = (this.turn = {});
      this.say("Trying off-line …");
      const trials = [];
      const rule = vmcCalibration[this.rule];
      for (const trial of rule(this.plan, (w) => this.endPoint(w), this.given.calibration)) {
        trials.push(trial);
        this.tell({ tries: `${trials.length - 1}` });
        await frame();
        if (turn !== this.turn) return;
      }
      const best = trials.reduce((a, b) => (b.error < a.error ? b : a));
      if (!(await this.play("calibrated", best, turn))) return;
      const which = best.n === undefined ? "" : ` (n = ${best.n})`;
      this.say(
        `After ${trials.length - 1} tries the best${which} misses by ` +
        `${millimetres(best.error, 1)}, moving at ${this.calibrated.speed}; ` +
        `the planned reach missed by ${millimetres(this.planned.error, 1)}.`
      );
    }
  }

  return { Reach };
})();
