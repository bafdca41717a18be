/* The reader's own camera, live: the stream follows a shuttlecock from frame to frame, and wherever it comes to rest
   the arm reaches for it (book/figures/your_photo.py). */
import { frame } from "../arm/live.js";
import { letterbox } from "../canvas.js";
import { distance } from "../vectors.js";
import { follow } from "./follow.js";
import { paintOver, paperLight, readSheet, sheetOutline } from "./marker_sheet.js";
import { EYE } from "./photo_reach.js";
import * as words from "./photo_words.js";
import { inPieces } from "./pieces.js";
import { see } from "./see.js";
import { unpack } from "./unpack.js";
import { YourPhoto } from "./your_photo.js";

const STILL = 700; // ms in one place, after which the arm reaches
const NEAR = 0.01, MOVED = 0.02; // m: what is still one place, and what is another
const CAMERA = { video: { facingMode: "environment", width: { ideal: 1200 }, height: { ideal: 800 } } };
const REFUSED = { NotAllowedError: "The camera was not allowed", NotFoundError: "No camera was found" };

/* A function that promises a picture of what a video shows. Its pixels are copied, where the browser can: of each
   frame that is drawn Chromium keeps a copy of its own, up to 512 MB. */
const snapshots = (video) => {
  const { width, height } = video, canvas = Object.assign(document.createElement("canvas"), { width, height });
  const context = canvas.getContext("2d", { willReadFrequently: true }), pixels = context.createImageData(width, height);
  const copy = async () => {
    const shown = new VideoFrame(video), rect = { x: 0, y: 0, width, height };
    await shown.copyTo(pixels.data, { format: "RGBA", rect }).finally(() => shown.close());
    context.putImageData(pixels, 0, 0);
    return canvas;
  };
  return () => copy().catch(() => video);
};

class LivePhoto extends YourPhoto {
  constructor(box) {
    super(box);
    const { live } = this.form.elements;
    live.hidden = !navigator.mediaDevices?.getUserMedia; // on a page from an insecure host, say
    live.addEventListener("click", () => {
      if (this.film) this.stopFilm();
      else if (!this.request) this.startFilm(); // disabled meanwhile, the button would lose the keyboard's focus
    });
    const { signal } = this.life;
    document.addEventListener("visibilitychange", () => document.hidden && this.stopFilm(), { signal });
  }

  /* Where stands how many frames a second are followed. */
  get pace() {
    return this.box.querySelector("[data-tell=followed]").parentElement;
  }

  look(picture) {
    this.stopFilm();
    return super.look(picture);
  }

  refuse(why) {
    this.stopFilm();
    super.refuse(why);
  }

  async startFilm() {
    const { live } = this.form.elements, video = Object.assign(document.createElement("video"), { muted: true, playsInline: true });
    const request = (this.request = {}); // until the reader chooses a photo, or leaves the page
    try {
      const film = await navigator.mediaDevices.getUserMedia(CAMERA);
      if (this.request !== request) return film.getTracks().forEach((track) => track.stop());
      video.srcObject = this.film = film;
      await video.play();
      if (this.film !== film) return;
      this.turn = {}; // what a photo led to, ends
      this.forget();
      live.textContent = "Stop";
      this.pace.hidden = false;
      this.say("Opening the eye …");
      this.brain = await unpack();
      await this.followFilm(Object.assign(video, { width: video.videoWidth, height: video.videoHeight }), film);
    } catch (error) {
      if (this.request !== request) return;
      this.stopFilm();
      this.say(`${REFUSED[error.name] ?? `The camera stopped: ${error.message}`}. A photo will do.`);
    }
  }

  stopFilm() {
    this.film?.getTracks().forEach((track) => track.stop());
    this.film = this.request = null;
    this.form.elements.live.textContent = "Live";
    this.pace.hidden = true;
  }

  /* Frame after frame, until the film stops. */
  async followFilm(video, film) {
    const { sheet } = this.given, snapshot = snapshots(video);
    Object.assign(this, { aimed: null, stay: null });
    for (let box = null, last = performance.now(); this.film === film; await frame()) {
      if (!film.active) throw new Error("it was unplugged, or taken by another program");
      const picture = await snapshot(), eye = letterbox(picture, ...EYE);
      const read = await inPieces(readSheet(eye, sheet, EYE, true)), { camera } = read;
      this.light = camera && paperLight(eye, camera, sheet); // before the sheet is painted over
      this.bare = camera ? paintOver(eye, sheetOutline(camera, sheet)) : eye;
      const found = box && camera && (await inPieces(follow(this.brain, this.bare, box, camera)));
      if (this.film !== film) return;
      this.drawSheet(read);
      this.photo.photo = picture;
      this.drawArm();
      if (!camera) this.say(words.needWords(read, sheet));
      else if (found) this.arriveAt((box = found));
      else box = await this.search(film);
      const now = performance.now();
      this.tell({ followed: `${(1000 / (now - last)).toFixed(0)} frames/s` });
      last = now;
    }
  }

  /* The box of a shuttlecock, wherever it is; or null. */
  async search(film) {
    this.say("Looking for a shuttlecock …");
    const report = (stage, found) => this.film === film && stage !== "sight" && this[`show${words.capital(stage)}`](found);
    const sight = await see(this.brain, this.bare, { camera: this.camera, report });
    if (this.film === film) this.tell({ found: words.foundWords(sight) });
    return sight.box;
  }

  /* A shuttlecock is in a box of this frame: its place is shown while it moves; when it rests, the arm reaches. */
  arriveAt(box) {
    const now = performance.now();
    Object.assign(this, { boxes: [box], marks: [{ box, colour: "green" }] });
    this.photo.drawBoxes(this.marks, 0);
    let place;
    try {
      place = this.locate(0);
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      return this.say(words.outOfReach(this.camera));
    }
    if (!(distance(place, this.stay?.place ?? place) < NEAR)) this.stay = null;
    this.stay ??= { place, since: now };
    if (this.aimed && distance(place, this.aimed) < MOVED) return;
    if (this.aimed) this.forgetReach();
    Object.assign(this, { turn: {}, aimed: null, place });
    this.tell({ place: words.placeWords(place) });
    this.rest();
    if (now - this.stay.since < STILL) return;
    this.aimed = place;
    this.choose(0).catch((error) => this.say(`The arm stopped: ${error.message ?? error}.`));
  }
}

export const start = (box) => {
  const photo = new LivePhoto(box);
  return () => {
    photo.stopFilm();
    photo.armInPhoto.end();
    photo.end();
  };
};

/* In the page every photo starts by itself. */
export const startAll = () => document.querySelectorAll(".vmc-eye").forEach(start);
