/* A reach for what is seen in a photo: the trunk turns, the arm moves in the scene, on the plot and in the photo. */
import { toWorld } from "../arm/kinematics.js";
import { frame } from "../arm/live.js";
import * as planning from "../arm/planning.js";
import { Reach } from "../arm/reach.js";
import { load } from "../arm/templates.js";
import { saveWithLine } from "../canvas.js";
import { calm } from "../demo/running.js";
import { mean, minus } from "../vectors.js";
import { ArmInPhoto } from "./arm_in_photo.js";
import { project } from "./camera.js";
import { PhotoMarks } from "./photo_marks.js";
import * as words from "./photo_words.js";

export const EYE = [600, 400]; // pixels: what the eye sees
const TURNING = 700; // ms, of the trunk
const INDOORS = [0.8, 0.8, 0.8]; // light, where no paper tells

export class PhotoReach extends Reach {
  constructor(box) {
    super(box);
    this.photo = new PhotoMarks(box.querySelector("svg:has(image)"), this.given);
    this.armInPhoto = new ArmInPhoto(this.drawing.view, EYE, this.photo.context);
    this.form.elements.keep.addEventListener("click", () => this.keep());
    this.bearing = 0;
    this.rest();
  }

  get guesses() {
    return words.isBare(this.read);
  }

  /* Turn the trunk, plan, move, miss, calibrate, move again. */
  async reach(target, bearing) {
    const { turn } = this, from = this.bearing;
    this.rest();
    if (!(await this.wake()) || turn !== this.turn) return; // it has said why
    Object.assign(this, { target, plan: planning.plan(target, this.templateSet) });
    const start = await frame();
    for (let share = calm.matches ? 1 : 0; ; share = Math.min(1, ((await frame()) - start) / TURNING)) {
      if (turn !== this.turn) return;
      this.bearing = from + share * (bearing - from);
      this.rest();
      if (share === 1) break;
    }
    this.form.elements.main.disabled = false;
    await this.main();
  }

  async ready() {
    this.templateSet = await load(this.given.templateSet);
    this.rule = "broydenCalibration";
  }

  /* The physics is there; what a reach is needed for, waits for one. */
  open() {
    super.open();
    this.closeReach();
  }

  closeReach() {
    for (const name of ["main", "keep"]) this.form.elements[name].disabled = true;
  }

  async main() {
    const { keep } = this.form.elements;
    keep.disabled = true;
    await super.main();
    if (this.planned) await this.calibrate();
    const { brain, calibrated, camera, planned, given } = this;
    if (!calibrated) return; // another photo was chosen
    const place = this.guesses
      ? words.guessWords(given.guess, camera, brain.selector)
      : words.placeAccuracyWords(given.placeAccuracy, camera);
    this.say(words.reachWords(calibrated.error, planned.error, this.guesses) + place + this.doubt);
    keep.disabled = !this.drawing.view.body; // without WebGL
  }

  /* The photo with the arm in it, and a line that says what it is, as a file. */
  keep() {
    this.drawArm();
    saveWithLine(this.photo.context.canvas, words.captionOf(this.calibrated.error, this.guesses), "reach.jpg");
  }

  world(point) {
    return toWorld(this.given.kinematics, point, this.bearing);
  }

  /* The arm as every reach begins, and what is known of the target. */
  rest() {
    const { start, rest } = this.given;
    this.mark([]);
    this.show({ q: start, activation: rest });
  }

  /* The sheet from above, for the example that is shown first, and wherever one is seen. */
  get sheetMarks() {
    const { read, photo, given } = this, { page } = given.sheet;
    if (photo.photo && (!read || words.isBare(read))) return [];
    return [["line", "grey", [...page, page[0]], 1.5], ["words", "ink", mean(page), "sheet", -4]];
  }

  /* The line of sight, the place and the hand's way: from above, in the scene, and on the photo. */
  mark(path) {
    const { camera, place, planned, calibrated } = this, way = path.map((point) => this.world(point));
    const ends = [[planned, "red"], [calibrated, "purple"]].map(([trial, colour]) => [trial && this.world(trial.hand), colour]);
    const reached = ends.filter(([end]) => end);
    this.drawing.balls = [place, ...ends.map(([end]) => end)];
    this.drawing.marks = [
      ...this.sheetMarks,
      ...(camera ? [["dot", "blue", camera.position, 4]] : []),
      ...(place ? [["line", "blue", [camera.position, place], 1.5], ["ring", "green", place, 6]] : []),
      ["line", "orange", way, 2],
      ...reached.map(([end, colour]) => ["dot", colour, end, 4]),
    ];
    if (!place) return;
    const pixel = (point) => project(camera, point);
    this.photo.drawReach(pixel(place), way.map(pixel), reached.map(([end, colour]) => [pixel(end), colour]));
  }

  show(moment, brief = false) {
    const joints = this.arm ? this.arm.look(moment.q).joints.map((joint) => this.world(joint)) : [];
    this.drawing.view.viewer?.set_transform(["meshcat", "goal"], [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...this.beyond, 1]);
    this.drawing.show({ ...moment, turn: this.bearing, joints }, brief);
    this.drawArm();
  }

  /* From the wrist to what the hand holds. */
  get beyond() {
    return minus(this.world(this.drawing.view.anatomy.beyond), this.world([0, 0, 0]));
  }

  /* The photo, and the arm in it as soon as a place is known to reach for. */
  drawArm() {
    const { camera, place, given, light } = this;
    this.photo.drawPhoto();
    if (camera && place) this.armInPhoto.draw(camera, this.beyond, given.table, light ?? INDOORS);
  }
}
