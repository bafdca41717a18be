/* Be the cerebellum: the reader changes the weights by hand, one try after the other. */
import { plus, signed, sum, times } from "../vectors.js";
import { millimetres } from "./live.js";
import { Aimed } from "./reach.js";

export class ByHand extends Aimed {
  constructor(box) {
    super(box);
    const { plan } = this.form.elements;
    plan.addEventListener("click", () => {
      this.aim(plan);
      this.begin();
    });
  }

  get hands() {
    return [0, 1, 2, 3].map((k) => this.form.elements[`weight-${k}`]); // they stand in another order
  }

  /* The habitual plan, or the same with the weights as the reader has `moved` them; another rule keeps these, the plan's
     own weights the tries alone. */
  propose(moved) {
    const plan = super.propose();
    if (this.hands.includes(moved)) this.own = this.hands.map((slider) => +slider.value);
    else if (moved?.name === "plan") this.own = null;
    else if (moved?.name !== "rule") Object.assign(this, { own: null, habit: null, tries: [] });
    plan.weights = this.own ?? plan.weights;
    this.showWeights(plan.weights);
    return plan;
  }

  showWeights(weights) {
    this.hands.forEach((slider, i) => {
      slider.value = weights[i];
      slider.nextElementSibling.textContent = signed(weights[i], 3);
    });
    this.tell({ sum: signed(sum(weights), 3) });
  }

  arrive(name, trial, end) {
    super.arrive(name, trial, end);
    this.showWeights(trial.weights);
  }

  /* Also where the weights put the mixture of the four places, Eq. 4, and where the plan and all tries so far ended. */
  mark(path) {
    super.mark(path);
    if (!this.plan) return;
    const { points, weights } = this.plan;
    this.drawing.marks.push(
      ["dot", "blue", points.map((point, i) => times(weights[i], point)).reduce(plus), 3],
      ...[this.habit, ...this.tries].filter(Boolean).map((place) => ["ring", "grey", place.reached, 2]));
  }

  sayMiss() {
    const { own, tries, planned } = this;
    if (!own) {
      this.habit = planned;
      return super.sayMiss(" Move a weight, and let go.");
    }
    if (`${tries.at(-1)?.weights}` !== `${planned.weights}`) tries.push(planned); // another rule is no try
    const best = Math.min(...tries.map(({ error }) => error)), { habit } = this;
    this.tell({ tries: `${tries.length}` });
    this.say(`It misses by ${millimetres(planned.error, 1)}; your best of ${tries.length}: ${millimetres(best, 1)}` +
      `${habit ? ` (the plan: ${millimetres(habit.error, 1)})` : ""}.`);
  }
}
