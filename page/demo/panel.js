/* What stands under a scene: its clock, the numbers of the moment it shows, the muscles by name, and a
   slider that turns it. One clock moves all scenes of a demo, and what else follows time there. */
import { clip, degrees, distance } from "../vectors.js";
import { redness } from "./muscles.js";
import { calm, showRunning } from "./running.js";

const SPEEDS = { "real time": 1, "half speed": 0.5, "quarter speed": 0.25 };
const SLOW_MOTION = 0.25; // of its speed
const PAUSE = 900, LIFTING = 900; // ms: to see the miss; then the hand lifts what it grasps, or tips it over
const LATE = 100; // ms: where pictures come late a movement takes longer, and is still seen whole
const WRIST = "The model ends at the wrist. The hand and its target are drawn one palm's length " +
  "beyond it.";

const element = (html) => {
  const box = document.createElement("template");
  box.innerHTML = html.trim();
  return box.content.firstElementChild;
};

/* What else in a demo's pictures follows the time: marks that have a course, place by place. */
const follow = ({ div, duration, time }) => {
  for (const mark of div.closest(".vmc-pictures").querySelectorAll("[data-course]")) {
    const course = mark.dataset.course.split(" ");
    const place = duration ? Math.round((time / duration) * (course.length - 1)) : 0;
    mark.setAttribute("transform", `translate(${course[place].replace(",", " ")})`);
  }
};

/* The times of the pictures that the browser draws, in ms, for as long as it `goesOn()`. */
const frames = async function* (goesOn) {
  for (;;) {
    const now = await new Promise(requestAnimationFrame);
    if (!goesOn()) return;
    yield now;
  }
};

/* The moments of a movement that are seen, from a `start` on: [time, how far the hand has lifted what it grasps]. In a
   film the last ones before the hold are slow. */
const moments = async function* ({ duration, settings: { miss } }, start, speed, film, goesOn) {
  const [slow, fast] = (film && miss?.slow) || [Infinity, Infinity];
  const pace = calm.matches ? 500 : 0; // ms between two pictures
  let last = 0, time = start, then = performance.now();
  for await (const now of frames(goesOn)) {
    const passed = clip(now - then, 0, LATE) / 1000;
    time = Math.min(duration, time + passed * speed.value * (time > slow && time < fast ? SLOW_MOTION : 1));
    then = now;
    if (now - last < pace && time < duration) continue;
    last = now;
    yield [time];
    if (time === duration) break;
  }
  if (!miss || !("lifted" in miss) || calm.matches) return;
  const lifted = performance.now() + PAUSE + LIFTING;
  for await (const now of frames(goesOn)) {
    const after = Math.min(1, 1 + (now - lifted) / LIFTING);
    if (after > 0) yield [duration, after];
    if (after === 1) break;
  }
};

/* Play, a slider of time, and how fast: shown where there is a movement. */
const clock = (views) => {
  const box = element(`<div class="vmc-control vmc-clock">
    <button type="button" class="vmc-play">Play the movement</button>
    <label>time <input type="range" min="0" step="0.01" value="0"></label>
    <output>0.00 s</output><select aria-label="speed">${Object.entries(SPEEDS)
      .map(([text, pace]) => `<option value="${pace}">${text}</option>`).join("")}</select></div>`);
  const [button, slider, output, speed] = box.querySelectorAll("button, input, output, select");
  const [view] = views;
  let playing = null;
  const stop = () => {
    playing = null;
    showRunning(button, false, "Play the movement");
  };
  const set = (time, after) => views.forEach((view) => view.at(time, after));
  const play = async ({ film = false } = {}) => {
    const mine = (playing = {}), goesOn = () => playing === mine && box.isConnected;
    showRunning(button, true, "Pause the movement");
    const start = +slider.value < view.duration ? +slider.value : 0;
    set(start);
    for await (const moment of moments(view, start, speed, film, goesOn)) set(...moment);
    if (goesOn()) stop();
  };
  button.addEventListener("click", () => (playing ? stop() : play()));
  slider.addEventListener("pointerdown", stop);
  slider.addEventListener("input", () => (stop(), set(+slider.value)));
  box.addEventListener("input", (event) => event.stopPropagation()); // no control of the demo
  Object.assign(box, { play, stop });
  view.listeners.push(() => {
    const { duration, time } = view, text = `${time.toFixed(2)} s`;
    box.hidden = !duration;
    slider.max = duration;
    slider.value = time;
    slider.setAttribute("aria-valuetext", text);
    output.textContent = text;
    follow(view);
  });
  return box;
};

/* The joints' angles, how far the hand is from the target now, and how the movement ends. */
const numbers = (view) => {
  const box = element(`<dl class="vmc-numbers simple"></dl>`);
  view.listeners.push((pose) => {
    if (!pose) return;
    const rows = [["shoulder", degrees(pose.q[0])], ["elbow", degrees(pose.q[1])]];
    const { target, end, miss } = view.settings;
    if (target) {
      const off = distance(view.anatomy.wrist(pose.q, pose.turn), target);
      rows.push(["hand to target now", `${(1000 * off).toFixed(1)} mm`]);
    }
    if (end) rows.push(miss ? ["miss over the hold", `${miss.mm.toFixed(1)} mm`] : ["end point to target", `${(1000 * end.off).toFixed(1)} mm`],
      ["speed in the hold", `${(1000 * end.speed).toFixed(0)} mm/s`]);
    box.innerHTML = rows.map(([name, text]) => `<div><dt>${name}</dt><dd>${text}</dd></div>`).join("");
  });
  return box;
};

const colour = (activation) =>
  `rgb(${redness(activation).map((x) => Math.round(255 * x)).join(" ")})`;

let panels = 0;

/* The muscles: which is which, how active each is now, and over the movement. */
const muscles = (view) => {
  const name = `vmc-muscle-${++panels}`;
  const box = element(`<div class="vmc-muscles" role="radiogroup" aria-label="muscles"><p>activation, from 0 <i></i> to 1</p></div>`);
  view.anatomy.muscles.forEach((muscle, k) => {
    const chip = element(`<label><input type="radio" name="${name}" value="${k}">
      <i></i><span>${muscle.name}</span>
      <svg viewBox="0 0 50 16" preserveAspectRatio="none" aria-hidden="true"><polyline/><line y2="16"/></svg>
      <b></b></label>`);
    for (const [type, shown] of [["pointerenter", k], ["pointerleave", null]])
      chip.addEventListener(type, () => view.body?.muscles.point(shown ?? chosenMuscle()));
    box.append(chip);
  });
  box.querySelector("i").style.background = `linear-gradient(90deg, ${
    [0, 0.04, 0.16, 0.36, 0.64, 1].map((a) => `${colour(a)} ${100 * a}%`)})`;
  const chosenMuscle = (view.chosen = () => box.querySelector(":checked")?.value ?? null);
  box.addEventListener("input", (event) => (event.stopPropagation(), view.body?.muscles.point(chosenMuscle())));
  view.onmuscle = (k) => (box.querySelectorAll("input")[k].checked = true);
  let drawn;
  view.listeners.push((pose) => {
    if (!pose) return;
    const chips = [...box.querySelectorAll("label")];
    const { motion } = view.settings;
    if (drawn !== motion) chips.forEach((chip, k) => trace(chip, motion.activation.map((a) => a[k])));
    drawn = motion;
    chips.forEach((chip, k) => {
      chip.querySelector("i").style.background = colour(pose.activation[k]);
      chip.querySelector("b").textContent = pose.activation[k].toFixed(2);
      const x = view.duration ? (50 * view.time) / view.duration : 0;
      chip.querySelector("line").setAttribute("transform", `translate(${x} 0)`);
    });
  });
  return box;
};

const trace = (chip, values) => {
  chip.querySelector("svg").style.display = values.length > 1 ? "" : "none";
  const points = values.map((v, i) => `${((50 * i) / (values.length - 1)).toFixed(1)},${(15 - 14 * Math.sqrt(v)).toFixed(1)}`);
  chip.querySelector("polyline").setAttribute("points", values.length > 1 ? points.join(" ") : "");
};

/* A slider that turns views, for hands on a keyboard; a mouse or a finger drags the scene itself. */
const turner = (views) => {
  const label = element(`<label class="vmc-control vmc-turn">turn the view
    <input type="range" min="-180" max="180" step="5" value="0"></label>`);
  const slider = label.querySelector("input");
  label.addEventListener("input", (event) => {
    event.stopPropagation();
    views.forEach((view) => view.turn(+slider.value));
  });
  views[0].listeners.push(() => (slider.value = views[0].turned));
  return label;
};

/* The muscles and what turns the view, behind a fold: for an arm that runs. */
export const foldOf = (view) => {
  const fold = element(`<details class="vmc-more"><summary>muscles, view</summary></details>`);
  fold.append(muscles(view), turner([view]));
  return fold;
};

/* All that a demo's scenes need, once they have an arm. The muscles and what turns the view stand behind a
   fold, and so do the numbers where a line of words tells how the movement ends. */
export const panelOf = (views) => {
  const [view] = views;
  const [box, behind] = [1, 2].map(() => element(`<div class="vmc-panel"></div>`));
  const fill = () => {
    if (!view.anatomy || box.childElementCount) return;
    const strip = view.div.closest(".vmc-pictures").querySelector(".vmc-strip");
    box.append(clock(views));
    (strip ? behind : box).append(numbers(view));
    behind.append(muscles(view));
    if (view.settings.target) behind.append(element(`<p class="vmc-note">${WRIST}</p>`));
    view.at(view.wanted);
  };
  view.listeners.push(fill);
  fill();
  return [box, behind, turner(views)];
};
