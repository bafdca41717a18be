/* Past experience in the reader's hand: templates are taken away and put back, and a reach becomes one. */
import { signed } from "../vectors.js";
import { Aimed } from "./reach.js";

const NEAR = 12, FINGER = 22; // px from a dot's middle that still are on it
const onHandle = ({ target }) => target.matches(".vmc-handle");

export class Experience extends Aimed {
  constructor(box) {
    super(box);
    const { keep, all } = this.form.elements;
    keep.addEventListener("click", () => this.keep());
    all.addEventListener("click", () => {
      this.forgetAdded();
      for (const one of this.boxes) one.checked = true;
      this.reachAgain();
    });
    this.controls.addEventListener("click", (event) => this.keepNeeded(event));
    const pictures = box.querySelector(".vmc-pictures");
    let down, up; // where a click truly was: a finger's is moved onto the handle beside it
    pictures.addEventListener("pointerdown", (event) => { // before the handle hears it
      down = up = event;
      if (!onHandle(event) && this.boxAt(event)) event.stopPropagation();
    }, true);
    pictures.addEventListener("pointerup", (event) => (up = event), true);
    pictures.addEventListener("click", (event) => {
      if (!down) return; // a screen reader's click, say, has no pointer
      const still = Math.hypot(up.clientX - down.clientX, up.clientY - down.clientY) < 4;
      const dot = still && this.boxAt(down);
      if (!dot) return;
      event.stopPropagation();
      dot.click();
    }, true);
  }

  /* A box to tick for each template, in their order. */
  get boxes() {
    return [...this.controls.querySelectorAll("[name=template]")];
  }

  get without() {
    return new Set(this.boxes.flatMap(({ checked }, row) => (checked ? [] : row)));
  }

  /* The box of the template that the reader points at on the plot, or through the handle on it. */
  boxAt(event) {
    const { target, clientX, clientY, pointerType } = event, { svg, measure } = this.drawing.plots[0];
    if (target.closest("svg") !== svg && !onHandle(event)) return null;
    const { left, top, width, height } = svg.getBoundingClientRect();
    const far = this.experience.points.map(measure.shareOf).map(([right, down]) =>
      Math.hypot(clientX - left - right * width, clientY - top - down * height));
    const least = Math.min(...far);
    return least < (pointerType === "touch" && !onHandle(event) ? FINGER : NEAR) ? this.boxes[far.indexOf(least)] : null;
  }

  /* A template without which there is no plan stays. */
  keepNeeded(event) {
    if (event.target.name !== "template" || event.target.checked || !this.plan) return;
    try {
      this.propose();
    } catch (error) {
      event.preventDefault();
      const words = `This template stays: without it, ${error.message}.`;
      if (!this.planned) this.stays = words; // or the reach under way would speak over it
      this.say(words);
    }
  }

  /* The reach that was just made becomes a template: its commands, and where they led. */
  async keep() {
    if (!this.planned || !this.arm) await this.begin();
    const { plan, templateSet, planned, calibrated } = this;
    if (!planned) return;
    const { weights, reached } = calibrated ?? planned;
    templateSet.add(reached, templateSet.excitations({ ...plan, weights }));
    const label = this.boxes.at(-1).parentElement.cloneNode(true);
    const place = reached.map((x) => signed(x, 3)).join(", ");
    label.lastChild.textContent = ` ${place}`;
    this.boxes.at(-1).parentElement.after(label);
    this.boxes.at(-1).checked = true;
    this.reachAgain();
    this.kept = ` Kept: template ${this.boxes.length}, at ${place}.`; // said now, and after the reach
    this.say(this.kept.trim());
  }

  /* The templates are again those that the book has. */
  forgetAdded() {
    const { points } = this.given.templateSet;
    for (const one of this.boxes.slice(points.length)) one.parentElement.remove();
    this.templateSet?.shorten(points.length);
  }

  aim(moved) {
    this.kept = "";
    super.aim(moved);
  }

  reachAgain() {
    this.aim();
    this.begin();
  }

  /* Also rings for what was taken away, and dots for what was added. */
  mark(path) {
    super.mark(path);
    const { points } = this.experience, { without } = this;
    const gone = points.filter((_, row) => without.has(row));
    const added = points.slice(this.given.templateSet.points.length);
    this.drawing.marks.unshift(
      ...added.map((point) => ["dot", "grey", point, 3]),
      ...gone.flatMap((point) => [["dot", "paper", point, 4], ["ring", "grey", point, 3]]));
  }

  sayMiss() {
    const all = this.boxes.length, { stays, kept } = this;
    Object.assign(this, { stays: null, kept: "" });
    if (stays) this.say(stays);
    else super.sayMiss(`${kept} ${all - this.without.size} of ${all} templates in use.`);
  }
}
