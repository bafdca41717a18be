/* In the page every arm starts by itself; a live kernel's is started by it. */
const vmcStart = (() => {
  "use strict";

  const modes = {
    bench: vmcBench.Bench, reach: vmcReach.Aimed, weights: vmcByHand.ByHand, templates: vmcExperience.Experience,
  };
  const start = (box) => new modes[box.dataset.mode](box);
  const startAll = () => document.querySelectorAll(".vmc-live:not([data-ready])").forEach(start);
  if (self.vmcKernel); // which starts its own
  else if (document.readyState === "loading") addEventListener("DOMContentLoaded", startAll);
  else startAll();
  return (box) => {
    const live = start(box);
    return () => {
      live.turn = null; // what runs, ends
      live.drawing.view.end();
    };
  };
})();
