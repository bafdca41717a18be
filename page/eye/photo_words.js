/* What the page says of a photo: what was found in it, what the arm needs, how well it reached. */
import { millimetres } from "../arm/live.js";
import { distance, dot, minus } from "../vectors.js";
import { hasRightSize } from "./box_selection.js";
import { physicalSize } from "./camera.js";
import { countWords } from "./see.js";
import { fromBeyond } from "./marker_sheet.js";

const AGAIN = "Another photo may do: from nearer, in even light.";
const POINT = "Point at a box, and the arm reaches for what is in it.";
const MEASURE = "measure the sheet’s line: if it is not 100 mm long, sizes and places are wrong.";
const SCALE = ` Is a shuttlecock there? Then ${MEASURE}`;

export const capital = (words) => words[0].toUpperCase() + words.slice(1);

/* What was found. */
export const foundWords = ({ summary }) => `${capital(summary)}.`;

/* How surely what is in a box that the reader chose is a shuttlecock. */
export const chanceWords = (chance) => `The box chosen: a shuttlecock, ${chance} sure.`;

/* A sheet that is seen from its far side may lie upside down. */
const upsideDownDoubt = (camera) => (fromBeyond(camera) ? " Does the sheet’s arrow point away from you?" : "");

export const outOfReach = (camera) =>
  `Out of reach: the hand can be where it is shaded. Lay it there, or point at another box.${upsideDownDoubt(camera)}`;

/* The camera of a sheet that was read, above the table. */
export const cameraWords = ({ markers, camera, why }, { fewest, first }) => {
  const seen = countWords(markers.length, "marker");
  if (camera) return `${(100 * (camera.position[1] - first[1])).toFixed(0)} cm above the table (${seen})`;
  return `unknown: ${seen} seen${why ? "" : `, ${fewest} needed`}`;
};

/* What the arm needs, where a sheet that was read gave no camera. */
export const needWords = ({ markers: { length }, why }, { fewest }) =>
  why ? `${capital(why)}. Then the arm can reach.`
    : "To reach, the arm needs the printed sheet: lay it flat on the table, all of it in the photo, in even light. " +
      `${length} of its markers ${length === 1 ? "is" : "are"} seen, ${fewest} are needed.`;

/* Whether nobody has laid a sheet: then the camera is guessed. */
export const isBare = ({ markers, why }) => !markers.length && !why;

/* What comes next; or what the reader may do, with so many boxes to choose from. */
export const nextWords = ({ box, boxes }, count, read, sheet) => {
  if (!count || (!boxes.length && !read.camera)) return AGAIN;
  if (!read.camera && !isBare(read)) return needWords(read, sheet);
  if (box) return "Planning the reach …";
  return POINT + (read.camera ? SCALE : "");
};

/* How far a hand ended from the place that it reached for. */
export const reachWords = (calibrated, planned, guesses) =>
  `Corrected by trial, the hand ends ${millimetres(calibrated, 1)} from the place ${guesses ? "guessed" : "seen"}; ` +
  `it began from ${millimetres(planned, 1)}. `;

/* How far off places are that a sheet tells: in half of the photos, in nine of ten. */
export const placeAccuracyWords = ([half, most], camera) =>
  `In half of our test photos that place is right to ${millimetres(half)}, in nine of ten to ${millimetres(most)}.${upsideDownDoubt(camera)}`;

/* What a place is that no sheet tells, and how far off its distance may be: shuttlecocks differ in size. Where a usual
   lens would see it nearer than is likely, the camera was taken away from it (camera.js). */
export const guessWords = ({ slant, size, place, nearest }, { position, rotation }, { sizes: [least, most] }) => {
  const cm = (metres) => `${(100 * metres).toFixed(0)} cm`, share = (most - least) / (most + least);
  const isPart = dot(rotation[2], minus(place, position)) < nearest + 1e-6, held = `${((180 * slant) / Math.PI).toFixed(0)}°`;
  const camera = isPart
    ? `With a phone’s usual lens a shuttlecock of ${cm(size)} would be nearer than ${cm(nearest)}. ` +
      `So this picture is taken as part of a larger photo, from ${cm(nearest)} away, held at ${held}.`
    : `With a phone’s usual lens, held at ${held}, a shuttlecock of ${cm(size)} is ${cm(distance(position, place))} from the camera, ` +
      `± ${(100 * share).toFixed(0)} %, as shuttlecocks differ in size.`;
  return `No sheet is seen, so the place is a guess, the same for every photo without one. ${camera} With the sheet it is measured.`;
};

/* What a picture is that a reader keeps. */
export const captionOf = (error, guesses) =>
  `A model arm of six muscles, drawn into a photograph. It missed the place ${guesses ? "guessed" : "seen"} by ${millimetres(error, 1)}.`;

/* What is to be said of a shuttlecock that, by the sheet, is too large or too small for one. */
export const sizeDoubt = ({ boxes, brain: { selector }, camera, marks }, number) => {
  if (marks[number].colour !== "green" || hasRightSize(boxes[number], camera, selector)) return "";
  const size = physicalSize(camera, boxes[number], selector.table);
  return ` By the sheet it is ${(100 * size).toFixed(0)} cm large, as no shuttlecock is: ${MEASURE}`;
};

/* A place, from the shoulder. */
export const placeWords = ([ahead, , right]) => {
  const [far, aside] = [ahead, right].map((x) => `${(100 * Math.abs(x)).toFixed(0)} cm`);
  return `${far} ${ahead > 0 ? "ahead" : "behind"}, ${aside} ${right > 0 ? "right" : "left"} of the shoulder`;
};
