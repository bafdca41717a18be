/* What runs by itself, and the button that starts and stops it. */

/* Whether the reader has asked the browser for less motion: `calm.matches`. */
export const calm = matchMedia("(prefers-reduced-motion: reduce)");

/* The button's words say what a press does next, so to a screen reader it is not "pressed". */
export const showRunning = (button, running, words) => {
  button.toggleAttribute("data-running", running);
  button.textContent = words;
};
