/* What all ways to move an arm share. */
import { foldOf } from "../demo/panel.js";
import { degrees, signed } from "../vectors.js";
import { Drawing } from "./drawing.js";
import { load } from "./load.js";

export const OFTEN = 6; // of so many frames one also moves the plot and the numbers: these are slow
const ACTIVE = 0.05; // what is called an active muscle
export const frame = () => new Promise(requestAnimationFrame);
export const millimetres = (metres, digits = 0) => `${signed(1000 * metres, digits)} mm`;

/* Who keeps the arm from running: the host's policy, its files, or the browser. */
const whyNot = (words) =>
  /content security|\bcsp\b|unsafe-eval/i.test(words)
    ? "The page's host forbids the physics: its policy must allow script-src 'unsafe-eval'." // MuJoCo's own glue
    : /^no \w+:/.test(words) ? `The page's host did not send a file of the book: there is ${words}.`
      : `This browser cannot run the arm: ${words}`;

export class Live {
  constructor(box) {
    this.box = box;
    this.life = new AbortController(); // what listens beyond the box, does so until the page has done with it
    this.given = JSON.parse(box.querySelector("script").textContent);
    this.drawing = new Drawing(box, this.given);
    this.form = box.querySelector("form");
    this.controls = this.form.querySelector("fieldset"); // closed until it is open
    const { view } = this.drawing;
    this.form.append(foldOf(view));
    view.pose(view.posed);
    const keep = (event) => event.stopPropagation(); // a notebook would take it
    this.form.addEventListener("keydown", keep);
    this.form.elements.main.addEventListener("click", () => this.begin());
    box.dataset.ready = "";
  }

  /* Whether the arm is there; it is loaded when it is first asked for. */
  wake() {
    return (this.loading ??= this.load());
  }

  async load() {
    const { signal } = this.life;
    this.say("Loading the physics …");
    await frame();
    try {
      const arm = await load(this.given);
      await this.drawing.view.wake();
      if (signal.aborted) {
        arm.free();
        return false;
      }
      this.arm = arm;
      await this.ready();
      if (signal.aborted) return false;
    } catch (error) {
      this.arm?.free();
      this.loading = this.arm = null;
      this.say(error.name === "KernelGone" ? error.message : whyNot(`${error.message ?? error}`));
      return false;
    }
    this.open();
    return true;
  }

  async begin() {
    if (await this.wake()) await this.main();
  }

  /* The page has done with it: what runs, ends. */
  end() {
    this.life.abort();
    this.turn = null;
    this.arm?.free();
    this.arm = null;
    this.drawing.view.end();
  }

  open() {
    for (const element of this.form.elements) element.disabled = false;
  }

  /* Show one moment of a movement, { q, activation }; if `brief`, in the scene alone. */
  show(moment, brief = false, seen = this.arm.look(moment.q)) {
    this.drawing.show({ ...moment, ...seen }, brief);
    const [forward, up, right] = seen.joints.at(-1);
    if (!brief) this.tell({
      shoulder: degrees(moment.q[0]), elbow: degrees(moment.q[1]),
      active: `${moment.activation.filter((a) => a > ACTIVE).length}`,
      forward: millimetres(forward), up: millimetres(up), right: millimetres(right),
    });
    return seen.joints.at(-1);
  }

  /* Put into words what the form has room for. */
  tell(values) {
    for (const place of this.box.querySelectorAll("[data-tell]"))
      place.textContent = values[place.dataset.tell] ?? place.textContent;
  }

  say(words) {
    const flat = this.arm && !this.drawing.view.viewer;
    const note = flat ? " (This browser draws no 3-D picture: watch the side view.)" : "";
    const law = this.arm?.muscle?.differs
      ? " (The muscle's law was changed in Python: this arm keeps the book's.)" : "";
    this.box.querySelector("[role=status]").textContent = words + note + law;
  }

  label(words) {
    this.form.elements.main.textContent = words;
  }
}
