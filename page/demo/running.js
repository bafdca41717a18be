/* A button that starts and stops: its words say what a press does next, so to a screen reader it is not "pressed". */
export const showRunning = (button, running, words) => {
  button.toggleAttribute("data-running", running);
  button.textContent = words;
};
