/* A demo in a live kernel, which works its states out. */
import { GONE } from "../kernel.js";
import { countOf, moveTo } from "./control.js";
import { start as startDemo } from "./demo.js";
import { viewOf } from "./scene.js";

const RUNNING = "The chapter is still running: the controls move as soon as it can answer.";

/* The first answer of a kernel. Until the browser has a channel beside the cells, a question waits
   behind them; so it is repeated. */
const firstAnswer = async (ask) => {
  for (let wait = 250, answer; ; wait *= 2) {
    const later = new Promise((resolve) => setTimeout(resolve, wait));
    if ((answer = await Promise.race([ask("ping"), later]))) return answer;
  }
};

/* A demo's states: `draw` is given the `first` at once, then what the kernel answers. Of places that
   come while it works, the last wins. An error stands below the picture; the still follows the reader. */
const states = (ask, box, first, model) => {
  let wanted, working, resting, last;
  const views = () =>
    [...box.querySelectorAll(".vmc-scene")].map((div) => viewOf(div).viewer?.capture_image() ?? "");
  const work = async (draw) => {
    working = true;
    box.setAttribute("aria-busy", "true");
    while (wanted !== undefined) {
      const place = (last = wanted);
      wanted = undefined;
      const state = await ask(place === model.get("place") ? "picture" : "state", place);
      if (ask.left) break;
      box.querySelector(".vmc-error").textContent = state.error ?? "";
      if (!state.error) draw(state);
    }
    working = false;
    box.removeAttribute("aria-busy");
    resting = setTimeout(() => ask("still", views()), 1000);
  };
  const show = (place, draw) => {
    if (first) return draw(first), (first = null), (last = place);
    clearTimeout(resting);
    wanted = place;
    if (!working) work(draw);
  };
  /* With words that say why, the controls are closed. */
  const close = (words) => {
    box.querySelector(".vmc-kernel").textContent = words;
    box.toggleAttribute("data-closed", words);
    for (const control of box.querySelectorAll("[data-stride], [data-stride] ~ .vmc-play"))
      control.disabled = words;
  };
  close(RUNNING);
  ask.onleave = () => close(GONE);
  /* The controls go where the kernel or another view has put them, but for where the last answer came from. */
  show.follow = () => {
    const place = model.get("place");
    if (place === last) return;
    for (const input of box.querySelectorAll("[data-stride]"))
      moveTo(input, Math.floor(place / input.dataset.stride) % countOf(input));
    box.dispatchEvent(new Event("input", { bubbles: true }));
  };
  show.ready = firstAnswer(ask).then(() => close(ask.left ? GONE : ""));
  return show;
};

export const start = (box, ask, first, model) => {
  const show = states(ask, box, first, model);
  const end = startDemo(box, show);
  show.follow();
  model.on("change:place", show.follow);
  return () => {
    model.off("change:place", show.follow);
    end?.();
  };
};
