/* Moves a demo's picture when the reader moves its controls. In the page every state was computed when
   the book was built and travels along: a table of lines, and each state as places in it. A live
   kernel is asked for each (live.js). */
import { clip } from "../vectors.js";
import { unzip } from "../vendored.js";
import { addAddress } from "./address.js";
import { axesOf } from "./axes.js";
import { stands } from "./control.js";
import { addHandle } from "./handle.js";
import { panelOf } from "./panel.js";
import { addPlay } from "./play.js";
import { viewOf } from "./scene.js";
import { addSound } from "./sound.js";

/* What the page works out itself, by name: see page/demos. */
export const works = {};

/* What lines of markup make, apart from the page. */
const contentOf = (lines) => Object.assign(document.createElement("template"), { innerHTML: lines.join("\n") }).content;

/* Make `node` equal to `next`, touching only what differs: images neither reload nor flicker. */
const morph = (node, next) => {
  if (node.nodeName !== next.nodeName) return node.replaceWith(next);
  if (node.nodeType !== Node.ELEMENT_NODE) {
    if (node.data !== next.data) node.data = next.data;
    return;
  }
  for (const { name } of [...node.attributes])
    if (!next.hasAttribute(name)) node.removeAttribute(name);
  for (const { name, value } of next.attributes)
    if (node.getAttribute(name) !== value) node.setAttribute(name, value);
  const old = [...node.childNodes], fresh = [...next.childNodes]; // both lists change on the way
  fresh.forEach((child, i) => (old[i] ? morph(old[i], child) : node.append(child)));
  old.slice(fresh.length).forEach((child) => child.remove());
};

/* The value at a place along values, which may lie between two; and the place of a value. */
const valueAt = (values, place) => {
  const low = Math.min(Math.floor(place), values.length - 2), part = place - low;
  if (part % 1 === 0) return values[place];
  return +(values[low] + part * (values[low + 1] - values[low])).toPrecision(12);
};
const placeOf = (values, value) => {
  const way = Math.sign(values[1] - values[0]);
  const passed = values.filter((one) => (value - one) * way >= 0).length - 1;
  const low = clip(passed, 0, values.length - 2);
  return low + (value - values[low]) / (values[low + 1] - values[low]);
};

/* A slider's text: between two of its own ones, which begin with numbers, a number of four digits. */
const textAt = (texts, place) => {
  if (place % 1 === 0) return texts[place];
  const numbers = texts.map((text) => parseFloat(text.replace("−", "-")));
  const [, after] = texts[0].match(/^−?[\d.]+(.*)/);
  return `${+valueAt(numbers, place).toPrecision(4)}`.replace("-", "−") + after;
};

const MOVES = /^motion\|\{"q":\[\[[^\]]*\],/; // of a scene's messages, a movement's: of more postures than one

/* The states that are stored in the page, as a function that gives one to `draw`. */
const askStored = async (demo) => {
  const kept = await unzip(demo.querySelector("script").textContent).json(), { lines, states, data } = kept;
  const ask = kept.work
    ? askComputed(kept)
    : (place, draw) => draw(states[place].map((places) => places.map((line) => lines[line])));
  return Object.assign(ask, { data, moves: lines?.some((line) => MOVES.test(line)) ?? true });
};

/* The same for states that the page computes: a function of the book, given the values that a place
   stands for, describes it in words and draws it on the pictures that came along. */
const askComputed = ({ work, grounds, given, grid }) => {
  const axes = grounds.map((lines) => axesOf(contentOf(lines).firstElementChild));
  const ask = (place, draw, at = {}) => {
    const values = grid.map((along, i) => {
      const stride = grid.slice(i + 1).reduce((product, { length }) => product * length, 1);
      return valueAt(along, at[stride] ?? Math.floor(place / stride) % along.length);
    });
    const [words, ...marks] = works[work](given, values, axes, place);
    draw([[words], ...grounds.map((lines, i) => [...lines.slice(0, -1), marks[i], "</svg>"])]);
  };
  const { views, between } = works[work];
  return Object.assign(ask, { views: views?.(given), between });
};

/* A pad: a handle on the first plot, or on each that has a view of a pad, moves its two sliders there, or to the
   nearest stop. A view may depend on where the other pads stand. Returns what puts all handles in their places. */
const addHandles = (demo, sliders, given) => {
  const pads = [...demo.querySelectorAll(".vmc-pad")].map((pad) =>
    ({ grid: JSON.parse(pad.dataset.grid), twins: [...pad.querySelectorAll("input")] }));
  const stand = () => pads.map(({ grid, twins }) => twins.map((twin, i) => valueAt(grid[i], +twin.value)));
  const identity = (place) => place;
  const views = given ?? pads.slice(0, 1).map(() => ({ toView: identity, fromView: identity }));
  const puts = views.map(({ pad = 0, picture = 0, toView, fromView }) => {
    const { grid, twins } = pads[pad];
    const put = addHandle(demo.querySelector(".vmc-pictures"), (seen) => {
      const place = fromView(seen, stand());
      grid.forEach((values, i) => {
        if (sliders.includes(twins[i])) twins[i].step = 0.1;
        twins[i].value = placeOf(values, place[i]);
      });
      twins[0].dispatchEvent(new Event("input", { bubbles: true }));
    }, picture);
    return () => put(toView(stand()[pad], stand()));
  });
  return () => puts.forEach((put) => put());
};

/* The demo's numbers in the page's sentences (vmc_lib/show/numbers.py). */
const tell = (demo) => {
  const words = demo.querySelector(".vmc-pictures").getAttribute("aria-label");
  for (const number of document.querySelectorAll(`.vmc-now[data-demo="${demo.id}"]`)) {
    const { place } = number.dataset, slider = document.getElementById(`${demo.id}-${place}`);
    const around = place.replace(/[^\w\s#]/g, "\\$&").replaceAll("#", "(−?\\d+(?:[.,]\\d+)*)");
    number.textContent = slider?.getAttribute("aria-valuetext") ?? words.match(around)?.[1] ?? "–";
  }
};

const all = { clean: (part) => part, cleanMessages: (messages) => messages }; // what the book drew needs no cut

/* A function that draws a state (its words and pictures, each a list of lines, cut to what is `allowed`), then calls `follow`. */
const drawer = (demo, follow) => {
  const [pictures, spoken] = [".vmc-pictures", ".vmc-spoken"].map((name) => demo.querySelector(name));
  const places = [".vmc-picture", ".vmc-data"].flatMap((name) => [...demo.querySelectorAll(name)]);
  return ([alt, ...parts], allowed = all) => {
    const row = demo.querySelector(".vmc-controls"), held = demo.matches(":hover, :focus-within");
    const top = () => row.getBoundingClientRect().top;
    const before = held && top();
    parts.forEach((lines, i) => {
      if (!lines) return; // it stands there already
      const picture = places[i], scene = picture.querySelector(".vmc-scene");
      if (scene) return viewOf(scene).show(allowed.cleanMessages(lines));
      const next = picture.cloneNode(false);
      next.append(allowed.clean(contentOf(lines)));
      morph(picture, next);
    });
    const words = alt.join();
    if (spoken && pictures.getAttribute("aria-label") !== words) spoken.textContent = words;
    pictures.setAttribute("aria-label", words);
    follow();
    queueMicrotask(() => tell(demo)); // sliders may yet say where they stand
    /* A picture of another height moves the page, and not what the reader's hand is on. */
    if (held && top() !== before) scrollBy({ top: top() - before, behavior: "instant" });
  };
};

/* `ask(place, draw)` gives `draw` the state at a place: its words and its pictures, as lines. */
export const start = (demo, ask) => {
  addSound(demo);
  const inputs = [...demo.querySelectorAll("[data-stride]")];
  const sliders = ask.between ? inputs.filter(({ dataset }) => "between" in dataset) : [];
  const draw = drawer(demo, addHandles(demo, sliders, ask.views));
  const show = () => {
    for (const input of inputs)
      if (input.dataset.texts) {
        const text = textAt(JSON.parse(input.dataset.texts), sliders.includes(input) ? +input.value : Math.round(input.value));
        input.setAttribute("aria-valuetext", text);
        input.nextElementSibling.textContent = text;
      }
    const exact = Object.fromEntries(sliders.map(({ dataset, value }) => [dataset.stride, +value]));
    demo.vmc.ask(inputs.reduce((sum, i) => sum + stands(i) * i.dataset.stride, 0), draw, exact);
    demo.dispatchEvent(new Event("vmc-shown")); // its link goes where it stands (address.js)
  };
  demo.vmc = { ask, show, data: ask.data }; // the page's Python may answer instead

  /* What the page works out anywhere follows the hand anywhere; keys that move it go from stop to stop. */
  const step = ({ key, target }) => {
    if (sliders.includes(target) && (!key || /^(Arrow|Page|Home|End)/.test(key))) target.step = key ? 1 : 0.1;
  };
  for (const type of ["pointerdown", "keydown"]) demo.addEventListener(type, step, true);
  const life = new AbortController();
  for (const button of demo.querySelectorAll(".vmc-play")) addPlay(demo, button, show, ask.ready, life.signal);
  demo.addEventListener("input", show);
  show();
  const scenes = [...demo.querySelectorAll(".vmc-pictures .vmc-scene")].map((div) => viewOf(div));
  if (scenes.length) {
    const panel = document.createElement("div");
    panel.className = "vmc-controls vmc-of-scene";
    const [shown, ...folded] = panelOf(scenes);
    panel.append(shown);
    panel.classList.toggle("vmc-unmoved", ask.moves === false);
    demo.querySelector(".vmc-controls").after(panel);
    demo.querySelector(".vmc-more").append(...folded);
  }
  demo.dataset.ready = "";
  return () => {
    life.abort();
    scenes.forEach((scene) => scene.end());
  };
};

/* Paper is white. */
const { dataset } = document.documentElement;
let theme;
addEventListener("beforeprint", () => ([theme, dataset.theme] = [dataset.theme, "light"]));
addEventListener("afterprint", () => (theme === undefined ? delete dataset.theme : (dataset.theme = theme)));

/* In the page every demo starts by itself. */
export const startAll = () =>
  document.querySelectorAll(".vmc-demo").forEach(async (demo) => {
    if (!demo.matches(":has(> script)")) return addSound(demo);
    const read = addAddress(demo), ask = await askStored(demo);
    read(ask.between);
    start(demo, ask);
  });
