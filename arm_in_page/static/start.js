/* In the page every arm starts by itself; a live kernel's widget brings its `page` along. */
const vmcStart = (() => {
  "use strict";

  const modes = { bench: vmcBench.Bench, reach: vmcReach.Reach };
  const start = (box) => new modes[box.dataset.mode](box);
  const startAll = () => document.querySelectorAll(".vmc-live:not([data-ready])").forEach(start);
  if (document.readyState === "loading") addEventListener("DOMContentLoaded", startAll);
  else startAll();
  return (el, page) => {
    el.innerHTML = page;
    const { view } = start(el.firstElementChild).drawing;
    return () => view.viewer && view.stop();
  };
})();
