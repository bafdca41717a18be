/* The reader's own photo, to a reach, in the page; where the eye is wrong the reader points at another box. */
import { turnTowards } from "../arm/kinematics.js";
import { frame } from "../arm/live.js";
import { drawScaled, fitScale, letterbox, PIXELS_HIDDEN, takePictures } from "../canvas.js";
import { degrees, times } from "../vectors.js";
import { guessCamera } from "./camera.js";
import { locate } from "./localiser.js";
import { paintOver, paperLight, readSheet, sheetOutline } from "./marker_sheet.js";
import { EYE, PhotoReach } from "./photo_reach.js";
import * as words from "./photo_words.js";
import { inPieces } from "./pieces.js";
import { countWords, percent, see } from "./see.js";
import { unpack } from "./unpack.js";

const LARGEST = 1200, MANY = 8; // pixels, of the longer side of what the sheet is read in; boxes to choose from

class Superseded extends Error {} // the reader has chosen another photo

export class YourPhoto extends PhotoReach {
  constructor(box) {
    super(box);
    const ours = box.querySelector("svg image").getAttribute("href"), { own, example, file } = this.form.elements;
    const take = takePictures(box, file, (picture) => this.look(picture), (why) => this.refuse(why));
    own.addEventListener("click", () => file.click());
    example.addEventListener("click", () => take(Object.assign(new Image(), { src: ours })));
    this.form.addEventListener("submit", (event) => event.preventDefault());
    addEventListener("paste", ({ target, clipboardData: { files } }) => {
      if (files.length && !target.closest(":read-write")) take(files[0]); // where one writes, the text is meant
    }, { signal: this.life.signal });
    box.addEventListener("click", ({ target }) => {
      const chosen = target.closest("[data-box]");
      if (chosen) this.point(+chosen.dataset.box);
    });
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
    this.diagonal = fitScale(canvas, ...EYE) * Math.hypot(canvas.width, canvas.height);
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
    report("eye", await unpack());
    await see(this.brain, this.bare, { camera, report });
  }

  /* Say why a file is no photo; what an earlier one led to, ends, lest it speaks after. */
  refuse(why) {
    const { photo } = this.photo;
    this.turn = {};
    if (photo) this.forget();
    if (photo) this.photo.show(photo);
    this.say(why);
  }

  /* Nothing is known of a new photo. */
  forget() {
    Object.assign(this, { read: null, camera: null, sight: null, boxes: [], bearing: 0 });
    this.tell({ found: "", camera: "–", candidates: "–", kept: "–", followed: "–" });
    this.box.querySelector(".vmc-boxes").hidden = true;
    this.forgetReach();
    this.rest();
  }

  /* Nothing is known of a reach for another box. */
  forgetReach() {
    Object.assign(this, { place: null, plan: null, planned: null, calibrated: null });
    this.tell({ place: "–", planned: "–", calibrated: "–" });
    this.photo.reach.innerHTML = "";
    this.closeReach();
  }

  showSheet(read) {
    this.drawSheet(read);
    this.rest();
  }

  drawSheet(read) {
    const { camera } = read, { sheet } = this.given;
    Object.assign(this, { read, camera });
    if (camera) this.photo.drawSheet(sheetOutline(camera, sheet));
    this.tell({ camera: words.cameraWords(read, sheet) });
  }

  showEye(brain) {
    this.brain = brain;
    this.say("Looking for things …");
  }

  showCandidates({ boxes }) {
    this.photo.drawCandidates(boxes);
    this.tell({ candidates: countWords(boxes.length, "box", "es") });
  }

  showKept({ boxes }) {
    this.boxes = boxes;
    this.photo.drawBoxes(boxes.map((box) => ({ box, colour: "orange" })));
    this.tell({ kept: countWords(boxes.length, "box", "es") });
  }

  showNames({ boxes, probability }) {
    const { minProbability } = this.brain.selector;
    this.photo.drawBoxes(boxes.map((box, i) => ({ box, colour: probability[i] > minProbability ? "green" : "blue" })));
  }

  /* The boxes that were refined; where there are none, the reader chooses among those kept. */
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
    const asks = boxes.length ? "How surely a shuttlecock?" : "Boxes that may hold a thing:";
    const reaches = this.camera || (this.guesses && boxes.length) ? " Press one, and the arm reaches for it:" : "";
    choice.innerHTML = `${asks}${reaches} ${this.marks.map(button).join("")}`;
    choice.hidden = !this.boxes.length;
    this.tell({ found: words.foundWords(sight) });
    this.say(words.nextWords(sight, this.boxes.length, this.read, this.given.sheet));
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

  /* Without a sheet, what is in a box is given a place, and the camera that would see it there. */
  guess(number) {
    const { guess } = this.given;
    this.camera = guessCamera(this.boxes[number], guess, times(0.5, EYE), this.diagonal);
    Object.assign(this, { place: guess.place, doubt: "" });
    this.tell({ place: "a guess" });
  }

  /* With a sheet, what is in a box is located. RangeError where it is out of reach. */
  measure(number) {
    this.doubt = words.sizeDoubt(this, number);
    this.place = this.locate(number);
    const place = words.placeWords(this.place);
    this.tell({ place });
    const { turn } = turnTowards(this.given.kinematics, this.place);
    this.tell({ place: `${place}; the trunk turns ${degrees(turn, 0)}` });
  }

  /* The reader points at a box: what is said of it then stands for what was found. */
  point(number) {
    if (this.sight.boxes.length) this.tell({ found: words.chanceWords(this.marks[number].words) });
    this.choose(number);
  }

  /* Reach for what is in a box. */
  async choose(number) {
    this.turn = {};
    this.forgetReach();
    this.photo.drawBoxes(this.marks, number);
    this.box.querySelectorAll("button[data-box]").forEach((button, i) => button.setAttribute("aria-pressed", i === number));
    if (!this.camera && !this.guesses) return this.say(words.needWords(this.read, this.given.sheet));
    try {
      if (this.guesses) this.guess(number);
      else this.measure(number);
      const { turn, place } = turnTowards(this.given.kinematics, this.place);
      await this.reach(place, turn);
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      this.rest();
      this.photo.drawPhoto(); // in it no arm reaches
      this.say(words.outOfReach(this.camera) + this.doubt);
    }
  }
}
