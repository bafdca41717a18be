import { calm, showRunning } from "./running.js";
import { viewOf } from "./scene.js";

/* A step is looked at for a while; if it brings a movement, for as long as that takes. */
const look = (demo, input) => {
  const clock = demo.querySelector(".vmc-clock:not([hidden])");
  if (clock) return clock.play({ film: true });
  const pause = calm.matches ? 1000 : Math.min(800, 5000 / input.max);
  return new Promise((done) => setTimeout(done, pause));
};

/* Paper shows where a demo leads, if the reader left it where it begins. */
const printEnd = (demo, input, show, signal) => {
  let begun = null;
  addEventListener("beforeprint", () => {
    if (input.value !== input.defaultValue) return;
    [begun, input.value] = [input.value, input.max];
    show();
    for (const still of demo.querySelectorAll(".vmc-scene:has(img)")) (viewOf(still).start(), viewOf(still).stop()); // anew
  }, { signal });
  addEventListener("afterprint", () => {
    if (begun === null) return;
    [input.value, begun] = [begun, null];
    show();
  }, { signal });
};

/* A button that walks through its slider's steps, of which each is to `show`; by itself, once `ready`, where that
   is asked for; until a `signal` says that the page has done with the demo. */
export const addPlay = (demo, button, show, ready, signal) => {
  const input = button.parentElement.querySelector("input");
  let playing = null;
  const stop = () => {
    playing = null;
    showRunning(button, false, "Play");
  };
  const stopAll = () => {
    if (playing) demo.querySelector(".vmc-clock")?.stop();
    stop();
  };
  button.addEventListener("click", async () => {
    if (playing) return stopAll();
    const mine = (playing = {});
    showRunning(button, true, "Pause");
    for (let step = input.value === input.max ? 0 : Math.round(input.value); step <= input.max; step++) {
      input.value = step;
      show();
      await look(demo, input);
      if (playing !== mine) return;
    }
    stop();
  });
  /* The reader's hand comes first, on whatever it lies; a movement's speed may change. */
  for (const type of ["pointerdown", "click", "input"]) // a key on a button makes a click alone
    demo.addEventListener(type, ({ target }) => {
      if (target.closest("[data-stride], .vmc-handle")) stopAll();
      if (target.closest(".vmc-clock :is(input, button)")) stop(); // the clock itself does as it is asked
    }, true);
  printEnd(demo, input, show, signal);
  if ("unasked" in button.dataset && !calm.matches) {
    const watch = new IntersectionObserver((entries) => {
      if (!entries.at(-1).isIntersecting) return;
      watch.disconnect();
      if (+input.value === 0) button.click();
    }, { threshold: 0.6 });
    Promise.resolve(ready).then(() => watch.observe(demo.querySelector(".vmc-pictures")));
  }
};
