/* The bench: six excitations in the reader's hand. */
import { calm } from "../demo/running.js";
import { degrees } from "../vectors.js";
import { frame, Live, OFTEN } from "./live.js";

export class Bench extends Live {
  ready() {
    this.sliders = this.given.muscles.map((name) => this.form.elements[name]); // in the model's order
    this.controls.addEventListener("input", () => this.hear());
    this.form.elements.step.addEventListener("click", () => this.advance(10));
    this.form.elements.reset.addEventListener("click", () => this.reset());
    const look = (entries) => (this.inSight = entries.at(-1).isIntersecting); // what it saw last counts
    new IntersectionObserver(look).observe(this.box);
    this.reset();
  }

  hear() {
    this.excitation = this.sliders.map((slider) => +slider.value);
    for (const slider of this.sliders)
      slider.nextElementSibling.textContent = (+slider.value).toFixed(2);
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
    const { state, activation } = this.arm;
    this.trail.push(this.show({ q: [...state.qpos], activation: [...activation] }, brief));
    this.trail = this.trail.slice(-300);
    if (!brief) this.tell({ time: `${(this.time / 1000).toFixed(2)} s` });
  }

  /* Run in real time, or pause; who wants less motion sees two pictures a second. */
  async main() {
    const turn = (this.turn = this.turn ? null : {});
    this.label(turn ? "Pause" : "Go on");
    this.advance(0);
    if (!turn) {
      const [shoulder, elbow] = [...this.arm.state.qpos].map((angle) => degrees(angle));
      const time = (this.time / 1000).toFixed(2);
      return this.say(`Paused at ${time} s. Shoulder ${shoulder}, elbow ${elbow}.`);
    }
    this.say("The arm is running.");
    const pace = calm.matches ? 500 : 0; // ms between two pictures
    for (let last = await frame(), now, n = 0; (now = await frame()), turn === this.turn; ) {
      if (now - last < pace) continue;
      const steps = Math.round(Math.min(now - last, Math.max(pace, 50)));
      if (this.inSight !== false) this.advance(steps, !pace && n++ % OFTEN > 0);
      last = now;
    }
  }
}
