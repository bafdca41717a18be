/* Be the cerebellum: the reader changes the weights by hand, one try after the other. */
const vmcByHand = (() => {
  "use strict";

  const { millimetres, signed } = vmcLive;
  const { plus, times } = vmcVectors;

  class ByHand extends vmcReach.Aimed {
    get hands() {
      return [...this.controls.querySelectorAll("[name^=weight-]")];
    }

    /* The habitual plan, or the same with the weights as the reader has `moved` them. */
    propose(moved) {
      const plan = super.propose();
      if (this.hands.includes(moved)) plan.weights = this.hands.map((slider) => +slider.value);
      else this.tries = [];
      this.hands.forEach((slider, i) => {
        slider.value = plan.weights[i];
        slider.nextElementSibling.textContent = signed(plan.weights[i], 3);
      });
      return plan;
    }

    /* Also where the weights put the mixture of the four places, Eq. 4, and all tries so far. */
    mark(path) {
      super.mark(path);
      if (!this.plan) return;
      const { points, weights } = this.plan;
      this.drawing.marks.push(
        ["dot", "blue", points.map((point, i) => times(weights[i], point)).reduce(plus), 3],
        ...this.tries.map((place) => ["ring", "grey", place.reached, 2]));
    }

    sayMiss() {
      const { tries, planned } = this;
      if (tries.push(planned) === 1) return super.sayMiss();
      const best = Math.min(...tries.map(({ error }) => error));
      this.tell({ tries: `${tries.length - 1}` });
      this.say(`It misses by ${millimetres(planned.error, 1)}; your best of ${tries.length - 1}: ${millimetres(best, 1)}.`);
    }
  }

  return { ByHand };
})();
