/* The reader's own photo, to a reach, in the page; where the eye is wrong the reader points at another box. */
import { toWorld, turnTowards } from "../arm/kinematics.js";
import { frame } from "../arm/live.js";
import * as planning from "../arm/planning.js";
import { Reach } from "../arm/reach.js";
import { load } from "../arm/templates.js";
import { drawScaled, letterbox, PIXELS_HIDDEN, takePictures } from "../canvas.js";
import { signed } from "../demo/panel.js";
import { minus, times } from "../vectors.js";
import { ArmInPhoto } from "./arm_in_photo.js";
import { guessCamera, project } from "./camera.js";
import { locate } from "./localiser.js";
import { paintOver, paperLight, readSheet, sheetOutline } from "./marker_sheet.js";
import { PhotoMarks } from "./photo_marks.js";
import * as words from "./photo_words.js";
import { inPieces } from "./pieces.js";
import { counted, percent, see } from "./see.js";
import { unpack } from "./unpack.js";

export const EYE = [600, 400], LARGEST = 1200; // pixels: what the eye sees, and the longer side of what the sheet is read in
const TURNING = 700, MANY = 8; // ms, of the trunk; boxes to choose from
const INDOORS = [0.8, 0.8, 0.8]; // light, where no paper tells
const LINE = 60; // pixels, below a picture that is kept

class Superseded extends Error {} // the reader has chosen another photo

export class YourPhoto extends Reach {
  constructor(box) {
    super(box);
    const svg = box.querySelector("svg:has(image)"), ours = svg.querySelector("image").getAttribute("href");
    this.photo = new PhotoMarks(svg, this.given);
    this.armInPhoto = new ArmInPhoto(this.drawing.view, EYE, this.photo.context);
    const { own, example, file, keep } = this.form.elements;
    const take = takePictures(box, file, (picture) => this.look(picture), (why) => this.say(why));
    own.addEventListener("click", () => file.click());
    example.addEventListener("click", () => this.takeExample(ours));
    keep.addEventListener("click", () => this.keep());
    this.form.addEventListener("submit", (event) => event.preventDefault());
    addEventListener("paste", ({ clipboardData: { files } }) => files.length && take(files[0]));
    box.addEventListener("click", ({ target }) => {
      const chosen = target.closest("[data-box]");
      if (chosen) this.choose(+chosen.dataset.box);
    });
  }

  async takeExample(address) {
    const picture = Object.assign(new Image(), { src: address });
    await picture.decode();
    return this.look(picture);
  }

  /* All stages, from a picture to the calibrated reach. */
  async look(picture) {
    const turn = (this.turn = {});
    try {
      await this.see(picture, (stage, found) => {
        if (turn !== this.turn) throw new Superseded();
        this[`show${words.capital(stage)}`](found);
      });
      if (turn === this.turn && this.sight.box) await this.choose(this.firstInReach());
    } catch (error) {
      if (!(error instanceof Superseded)) this.say(`The eye stopped: ${error.message ?? error}.`);
    }
  }

  /* What the eye makes of a picture; `report` is told of each stage. */
  async see(picture, report) {
    const canvas = document.createElement("canvas");
    const context = drawScaled(picture, Math.min(1, LARGEST / Math.max(picture.width, picture.height)), canvas);
    if (!context) throw new Error(PIXELS_HIDDEN);
    this.forget();
    this.photo.show(canvas);
    this.diagonal = this.photo.scale(EYE) * Math.hypot(canvas.width, canvas.height);
    this.say("Looking for the sheet …");
    await frame();
    const large = context.getImageData(0, 0, canvas.width, canvas.height), { sheet } = this.given;
    const read = await inPieces(readSheet(large, sheet, EYE));
    report("sheet", read);
    const eye = letterbox(canvas, ...EYE), { camera } = read;
    this.light = camera && paperLight(eye, camera, sheet);
    this.bare = camera ? paintOver(eye, sheetOutline(camera, sheet)) : eye;
    this.say("Opening the eye …");
    await frame();
    this.brain = await unpack();
    this.say("Looking for things …");
    await see(this.brain, this.bare, { camera, report });
  }

  /* Nothing is known of a new photo, */
  forget() {
    Object.assign(this, { read: null, camera: null, sight: null, boxes: [], bearing: 0 });
    this.tell({ found: "", camera: "–", candidates: "–", kept: "–", followed: "–" });
    this.box.querySelector(".vmc-boxes").hidden = true;
    this.forgetReach();
    this.rest();
  }

  /* or of a reach for another box. */
  forgetReach() {
    Object.assign(this, { place: null, plan: null, planned: null, calibrated: null });
    this.tell({ place: "–", planned: "–", calibrated: "–" });
    this.photo.reach.innerHTML = "";
    for (const name of ["main", "keep"]) this.form.elements[name].disabled = true;
  }

  showSheet(read) {
    this.drawSheet(read);
    this.rest();
  }

  drawSheet(read) {
    const { camera } = read, { sheet } = this.given;
    Object.assign(this, { read, camera });
    if (camera) this.photo.drawSheet(sheetOutline(camera, sheet));
    this.tell({ camera: words.camera(read, sheet) });
  }

  showCandidates({ boxes }) {
    this.photo.drawCandidates(boxes);
    this.tell({ candidates: counted(boxes.length, "box", "es") });
  }

  showKept({ boxes }) {
    this.boxes = boxes;
    this.photo.drawBoxes(boxes.map((box) => ({ box, colour: "orange" })));
    this.tell({ kept: counted(boxes.length, "box", "es") });
  }

  showNames({ boxes, probability }) {
    this.photo.drawBoxes(boxes.map((box, i) => ({ box, colour: probability[i] > 0.5 ? "green" : "blue" })));
  }

  /* The boxes that were looked at twice; where there are none, the reader chooses among those kept. */
  showSight(sight) {
    const { boxes, shuttlecocks, probability } = sight, choice = this.box.querySelector(".vmc-boxes");
    this.sight = sight;
    this.boxes = (boxes.length ? boxes : this.boxes).slice(0, MANY);
    this.marks = this.boxes.map((box, i) => ({
      box, colour: i < shuttlecocks.length ? "green" : "blue", words: boxes.length ? percent(probability[i]) : `${i + 1}`,
    }));
    this.photo.drawBoxes(this.marks);
    const button = ({ words, colour }, i) =>
      `<button type="button" data-box="${i}" aria-pressed="false" class="vmc-${colour}">${words}</button>`;
    const asks = boxes.length ? "How surely a shuttlecock?" : "Boxes that were kept:";
    const reaches = this.camera || (this.guesses && boxes.length) ? " Press one, and the arm reaches for it:" : "";
    choice.innerHTML = `${asks}${reaches} ${this.marks.map(button).join("")}`;
    choice.hidden = !this.boxes.length;
    this.tell({ found: words.found(sight) });
    this.say(words.next(sight, this.boxes.length, this.read, this.given.sheet));
  }

  get guesses() {
    return words.isBare(this.read);
  }

  /* Of the shuttlecocks the first that the arm can reach; else the first. */
  firstInReach() {
    const { boxes, camera, sight } = this;
    const inReach = (_, i) => i < sight.shuttlecocks.length && this.isInReach(i);
    return camera ? Math.max(0, boxes.findIndex(inReach)) : 0;
  }

  isInReach(number) {
    try {
      return Boolean(turnTowards(this.given.kinematics, this.locate(number)));
    } catch (error) {
      if (error instanceof RangeError) return false;
      throw error;
    }
  }

  /* Where what is in a box stands on the table. */
  locate(number) {
    return locate(this.brain.localiser, this.bare, this.boxes[number], this.camera);
  }

  /* Reach for what is in a box. */
  async choose(number) {
    this.turn = {};
    this.forgetReach();
    this.photo.drawBoxes(this.marks, number);
    this.box.querySelectorAll("button[data-box]").forEach((button, i) => button.setAttribute("aria-pressed", i === number));
    const { guess, sheet } = this.given;
    if (this.guesses) this.camera = guessCamera(this.boxes[number], guess, times(0.5, EYE), this.diagonal);
    if (!this.camera) return this.say(words.need(this.read, sheet));
    this.doubt = this.guesses ? "" : words.sizeDoubt(this, number);
    try {
      this.place = this.guesses ? guess.place : this.locate(number);
      this.tell({ place: words.where(this.place) });
      const { turn, place } = turnTowards(this.given.kinematics, this.place);
      const measured = `${words.where(this.place)}; the trunk turns ${signed((turn * 180) / Math.PI, 0)}°`;
      this.tell({ place: this.guesses ? "a guess" : measured });
      await this.reach(place, turn);
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      this.rest();
      this.say(words.outOfReach(this.camera) + this.doubt);
    }
  }

  /* Turn the trunk, plan, move, miss, calibrate, move again. */
  async reach(target, bearing) {
    const { turn } = this, from = this.bearing;
    this.rest();
    if (!(await this.awake()) || turn !== this.turn) return; // it has said why
    Object.assign(this, { target, plan: planning.plan(target, this.templateSet) });
    const start = await frame();
    for (let share = this.calm.matches ? 1 : 0; ; share = Math.min(1, ((await frame()) - start) / TURNING)) {
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

  async main() {
    const { keep } = this.form.elements;
    keep.disabled = true;
    await super.main();
    if (this.planned) await this.calibrate();
    const { calibrated, camera, planned, given } = this;
    if (!calibrated) return; // another photo was chosen
    const place = this.guesses ? words.guessed(given.guess) : words.placed(given.placeAccuracy, camera);
    this.say(words.reached(calibrated.error, planned.error) + place + this.doubt);
    keep.disabled = !this.drawing.view.body; // without WebGL
  }

  /* The photo with the arm in it, and a line that says what it is, as a file. */
  keep() {
    const { context } = this.photo, { width, height } = context.canvas, line = words.kept(this.calibrated.error, this.guesses);
    const canvas = Object.assign(document.createElement("canvas"), { width, height: height + LINE }), ink = canvas.getContext("2d");
    this.drawArm();
    ink.fillStyle = "white";
    ink.fillRect(0, 0, width, height + LINE);
    ink.drawImage(context.canvas, 0, 0);
    Object.assign(ink, { fillStyle: "black", font: `${LINE / 2.4}px sans-serif`, textBaseline: "middle" });
    ink.fillText(line, LINE / 2, height + LINE / 2, width - LINE);
    const href = canvas.toDataURL("image/jpeg", 0.92);
    Object.assign(document.createElement("a"), { href, download: "reach.jpg" }).click();
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

  /* The line of sight, the place and the hand's way: from above, in the scene, and on the photo. */
  mark(path) {
    const { camera, place, planned, calibrated } = this, way = path.map((point) => this.world(point));
    const ends = [[planned, "red"], [calibrated, "purple"]].map(([trial, colour]) => [trial && this.world(trial.hand), colour]);
    const reached = ends.filter(([end]) => end);
    this.drawing.balls = [place, ...ends.map(([end]) => end)];
    this.drawing.marks = [
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
    this.photo.drawPhoto();
    this.drawArm();
  }

  /* From the wrist to what the hand holds. */
  get beyond() {
    return minus(this.world(this.drawing.view.anatomy.beyond), this.world([0, 0, 0]));
  }

  /* The arm in the photo, as soon as a place is known to reach for. */
  drawArm() {
    const { camera, place, given, light } = this;
    if (camera && place) this.armInPhoto.draw(camera, this.beyond, given.table, light ?? INDOORS);
  }
}
