/* The reach: the reader sets a target; the page plans, moves, misses, calibrates. */
import { addHandle } from "../demo/handle.js";
import { calm } from "../demo/running.js";
import { clip, distance, mean, signed, sum } from "../vectors.js";
import * as calibrations from "./calibration.js";
import { frame, Live, millimetres, OFTEN } from "./live.js";
import * as planning from "./planning.js";
import { load } from "./templates.js";

/* How far [up, aside] of a point its words stand: beyond it as seen from the target, within the plot's frame. */
const beyond = ({ svg, measure: { place, left, right, bottom, top } }, target, point, words) => {
  const { width, height } = svg.viewBox.baseVal, [[x0, y0], [x, y]] = [target, point].map(place);
  const far = Math.hypot(x - x0, y - y0) || 1, half = 3 * words.length + 2;
  const aside = clip(x + ((10 + half) * (x - x0)) / far, left * width + half, right * width - half) - x;
  return [y - clip(y + (14 * (y - y0)) / far + 4, top * height + 11, bottom * height - 4), aside];
};
const pace = ({ speed }) => `${millimetres(speed)}/s`;

/* A reach that is planned: played, missed, calibrated. */
export class Reach extends Live {
  motion(weights) {
    return this.arm.reach(this.templateSet.excitations({ ...this.plan, weights }));
  }

  hold(weights) {
    return this.arm.hold(this.motion(weights));
  }

  /* Play a movement in its own time. */
  async play(name, trial, turn) {
    const motion = this.motion(trial.weights);
    const step = 1000 * this.given.step; // ms
    const every = Math.ceil(10 / step); // of its moments the path has one
    const path = motion.filter((_, t) => t % every === 0).map(({ q }) => this.arm.hand(q));
    const start = await frame();
    for (let n = 0, t = calm.matches ? motion.length : 0; t < motion.length - 1; n++) {
      this.mark(path.slice(0, 1 + t / every));
      this.show(motion[t], n % OFTEN > 0);
      t = Math.max(0, Math.round(((await frame()) - start) / step));
      if (turn !== this.turn) return false;
    }
    const hold = this.arm.hold(motion);
    const way = sum(hold.slice(1).map((place, t) => distance(place, hold[t])));
    const speed = way / (this.given.held * this.given.step);
    this.arrive(name, { ...trial, hand: mean(hold), speed }, { path, ...motion.at(-1) });
    return true;
  }

  /* A movement has come to its end, in a posture and by a path; its `trial` is now known as `name`. */
  arrive(name, trial, end) {
    this[name] = trial;
    this.mark(end.path);
    const miss = { mm: 1000 * trial.error, end: this.world(trial.hand), turn: this.bearing };
    this.show({ ...end, miss }, false, end.joints && end);
    this.tell({
      [name]: millimetres(trial.error, 1),
      speed: pace(trial),
      weights: trial.weights.map((w) => signed(w, 2)).join(", "),
    });
  }

  /* Where in the scene a place lies that the arm's model tells. */
  world(place) {
    return place;
  }

  sayMiss(next = "") {
    this.say(
      `The planned reach misses by ${millimetres(this.planned.error, 1)}, on average over the hold; ` +
      `there the hand still moves at ${pace(this.planned)}.${next}`
    );
  }

  /* The habitual reach. */
  async main() {
    const turn = (this.turn = {});
    if (!this.plan) return;
    const own = this.form.elements.weights?.value === "habitualWeights" && (await this.box.vmcLaw?.(this.plan));
    if (turn !== this.turn) return;
    if (own) this.plan = { ...this.plan, weights: own }; // by the reader's Eq. 5 (page/python)
    Object.assign(this, { planned: null, calibrated: null });
    this.tell({ calibrated: "–", tries: "–" });
    const reach = (weights) => this.hold(weights);
    const [first] = calibrations.algorithm1(this.plan, reach, { gains: [] });
    if (!(await this.play("planned", first, turn))) return;
    this.sayMiss();
  }

  /* Try off-line, as fast as the page can; then move once more, with the best weights. */
  async calibrate() {
    if (!this.planned || !this.arm) await this.begin();
    if (!this.planned) return;
    const turn = (this.turn = {});
    this.say("Correcting by trial …");
    const trials = [];
    const rule = calibrations[this.rule];
    for (const trial of rule(this.plan, (w) => this.hold(w), this.given.calibration)) {
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
      `${millimetres(best.error, 1)}, moving at ${pace(this.calibrated)}; ` +
      `it began from ${millimetres(this.planned.error, 1)}.`
    );
  }
}

/* The same, to a target that the reader sets on the sliders or the plot. */
export class Aimed extends Reach {
  constructor(box) {
    super(box);
    const { first } = this.given;
    this.form.elements.calibrate.addEventListener("click", () => this.calibrate());
    this.controls.addEventListener("input", ({ target }) => this.aim(target));
    this.controls.addEventListener("change", () => this.begin());
    this.sliders = ["forward", "up", "right"].flatMap((way) => this.form.elements[way] ?? []);
    const pictures = box.querySelector(".vmc-pictures");
    this.handles = this.drawing.plots.map(({ axes }, nth) => {
      const put = addHandle(pictures, (place) => {
        axes.forEach((axis, i) => (this.sliders[axis].value = place[i]));
        this.aim();
      }, nth, () => this.begin());
      return (place) => put(axes.map((axis) => place[axis]));
    });
    this.label("Reach");
    this.open();
    this.stored = first;
    this.aim();
    this.goal = (first ?? this.given).goal; // the physics is not there to say it
    this.mark([]);
    this.drawing.place();
    if (!first) return;
    this.arrive("planned", first, first);
    this.sayMiss();
  }

  async ready() {
    this.templateSet = await load(this.given.templateSet);
    this.aim(this.moved);
  }

  propose() {
    const rule = planning[this.form.elements.weights.value];
    return planning.plan(this.target, this.experience, rule, this.without);
  }

  get experience() {
    return this.templateSet ?? this.given.templateSet; // before the physics is there
  }

  /* Take the target from the sliders and plan anew, as one of them has `moved`; what was under way ends. */
  aim(moved) {
    this.turn = {}; // whose turn it is: whoever waited for a frame looks whether it is still his
    for (const slider of this.sliders)
      slider.nextElementSibling.textContent = `${signed(+slider.value, 3)} m`;
    const target = this.sliders.map((slider) => +slider.value);
    Object.assign(this, { moved, target, rule: this.form.elements.rule.value, plan: null });
    Object.assign(this, { goal: null, planned: null, calibrated: null });
    this.tell({ planned: "–", calibrated: "–", weights: "–", tries: "–", speed: "–" });
    try {
      this.plan = this.propose(moved);
      this.goal = this.arm?.place(target);
      this.say("A target is set: let the arm reach for it.");
    } catch (error) {
      this.say(`Nothing planned: ${error.message}`);
    }
    this.mark([]);
    for (const put of this.handles) put(this.target);
    const { start, rest } = this.given;
    if (this.arm) this.show({ q: start, activation: rest });
    else if (this.stored) this.show(this.stored, false, this.stored);
  }

  /* All on the plot and in the scene but the arm: target, templates, ends, the hand's path. */
  mark(path) {
    const { plan, target, planned, calibrated } = this;
    const shown = (calibrated ?? planned)?.weights ?? plan?.weights;
    const width = (i) => 8 * Math.abs(shown[i]);
    const threads = plan?.points.map((p, i) => ["line", "blue", [target, p], width(i)]);
    const label = (p, words) => ["words", "ink", p, words, beyond(this.drawing.plots[0], target, p, words)];
    const weights = target.length > 2 ? [] : plan?.points.map((p, i) => label(p, signed(shown[i], 2)));
    const ends = [[planned, "red"], [calibrated, "purple"]].filter(([trial]) => trial);
    this.drawing.marks = [
      ...(threads ?? []),
      ["line", "orange", path, 2],
      ["ring", "green", target, 7],
      ...(weights ?? []),
      ...ends.map(([trial, colour]) => ["dot", colour, trial.reached, 4]),
    ];
    this.drawing.focus = target;
    this.drawing.balls = [this.goal, planned?.hand, calibrated?.hand];
  }

  sayMiss(next = " Drag the target, and let go.") {
    super.sayMiss(next);
  }
}
