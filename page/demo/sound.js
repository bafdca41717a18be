/* Sonification: a reader hears the curves of a demo's plots. In two seconds from a plot's left to its
   right a tone is as high as the curve, two octaves from the plot's bottom to its top. One curve follows
   the other; where a plot has two, both sound once more together, one in each ear. */
import { clip } from "../vectors.js";
import { addSign } from "./address.js";
import { axesOf } from "./axes.js";
import { showRunning } from "./running.js";

const LONG = 2, PAUSE = 0.8, SOFT = 0.02; // seconds
const LOWEST = 220, OCTAVES = 2, LOUD = 0.15; // Hz; above it; gain
let stop = () => {}; // what sounds now, of whichever demo

/* Where in its picture the plot of a line lies: left, right, bottom, top. */
const frame = (line) => {
  const svg = line.ownerSVGElement, { width, height } = svg.viewBox.baseVal;
  const clipId = /#([^)"]*)/.exec(line.getAttribute("clip-path"))?.[1];
  const box = clipId && svg.querySelector(`[id="${clipId}"] rect`)?.getBBox();
  if (box) return [box.x, box.x + box.width, box.y + box.height, box.y];
  const { left, right, bottom, top } = axesOf(svg);
  return [width * left, width * right, height * bottom, height * top];
};

/* A line's unbroken stretches, each a list of [time, frequency]. */
const stretches = (line) => {
  const [left, right, bottom, top] = frame(line);
  const tone = ([x, y]) => {
    const share = clip((y - bottom) / (top - bottom), 0, 1);
    return [(LONG * (x - left)) / (right - left), LOWEST * 2 ** (OCTAVES * share)];
  };
  return (line.getAttribute("d") ?? line.getAttribute("points")).split("M").map((stretch) => {
    const points = [...stretch.matchAll(/(-?[\d.]+)[ ,]+(-?[\d.]+)/g)].map(([, ...point]) => tone(point.map(Number)));
    return points.filter(([time]) => time >= 0 && time <= LONG);
  }).filter(({ length }) => length);
};

const schedule = (audio, line, start, ear) => {
  const side = new StereoPannerNode(audio, { pan: ear });
  side.connect(audio.destination);
  for (const points of stretches(line)) {
    const tone = new OscillatorNode(audio, { type: "triangle" }), loud = new GainNode(audio, { gain: 0 });
    tone.connect(loud).connect(side);
    const [begin, end] = [points[0], points.at(-1)].map(([time]) => start + time);
    points.forEach(([time, frequency], i) =>
      tone.frequency[i ? "exponentialRampToValueAtTime" : "setValueAtTime"](frequency, start + time));
    for (const [height, time] of [[0, begin], [LOUD, begin + SOFT], [LOUD, end], [0, end + SOFT]])
      loud.gain.linearRampToValueAtTime(height, time);
    tone.start(begin);
    tone.stop(end + SOFT);
  }
};

/* What is heard one after the other: lists of curves. */
const turns = (demo) => {
  const plots = new Map();
  for (const curve of demo.querySelectorAll("[data-curve]")) {
    const plot = [...demo.querySelectorAll("svg")].indexOf(curve.ownerSVGElement) + frame(curve).join();
    plots.set(plot, [...(plots.get(plot) ?? []), curve]);
  }
  return [...plots.values()].flatMap((some) => [...some.map((one) => [one]), ...(some.length === 2 ? [some] : [])]);
};

const listen = (demo, button, said) => {
  const audio = new AudioContext(), waits = [], all = turns(demo), each = LONG + PAUSE;
  const show = (heard) => {
    demo.querySelectorAll("[data-curve]").forEach((curve) => curve.classList.toggle("vmc-heard", heard.includes(curve)));
    said.textContent = heard.map((curve) => curve.dataset.curve).join(" and ");
  };
  all.forEach((heard, i) => { // its name first
    heard.forEach((curve, k) => schedule(audio, curve, audio.currentTime + i * each + PAUSE, heard.length > 1 ? 2 * k - 1 : 0));
    waits.push(setTimeout(show, 1000 * i * each, heard));
  });
  waits.push(setTimeout(() => stop(), 1000 * all.length * each));
  showRunning(button, true, "Stop");
  stop = () => {
    waits.forEach(clearTimeout);
    show([]);
    audio.close();
    showRunning(button, false, "Listen");
    stop = () => {};
  };
};

export const addSound = (demo) => {
  const button = document.createElement("button"), said = document.createElement("span");
  Object.assign(button, { type: "button", className: "vmc-listen", textContent: "Listen", title: "Hear the curves: the higher, the higher" });
  said.setAttribute("role", "status");
  const caption = demo.querySelector("figcaption") ?? demo;
  addSign(caption, button);
  caption.append("\u00a0", said);
  button.addEventListener("click", () => {
    const sounds = "running" in button.dataset;
    stop();
    if (!sounds) listen(demo, button, said);
  });
  demo.addEventListener("vmc-shown", () => "running" in button.dataset && stop()); // these curves are gone
};
