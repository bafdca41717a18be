/* Tells a platform by SCORM 1.2 what its student has done: predicted, and then moved the demo. Half of the score is
   for each, whatever the prediction was; both together complete it, or the move where nothing is asked. A later visit
   goes on from the score that the platform has kept. Without a platform it is silent. */
(() => {
  "use strict";

  const findApi = (frame) => frame.API ?? (frame.parent === frame ? null : findApi(frame.parent));
  let api;
  try {
    api = findApi(self) ?? (self.opener && findApi(self.opener));
  } catch {
    return; // a page of another host, which may not be looked into
  }
  if (`${api?.LMSInitialize("")}` !== "true") return;
  addEventListener("pagehide", () => api.LMSFinish(""), { once: true });
  if (api.LMSGetValue("cmi.core.lesson_status") === "completed") return; // and stays so

  const tell = (status, score) => {
    const values = { lesson_status: status, "score.min": 0, "score.max": 100, "score.raw": score };
    for (const [name, value] of Object.entries(values)) api.LMSSetValue(`cmi.core.${name}`, `${value}`);
    api.LMSCommit("");
  };
  const question = document.querySelector(".vmc-predict"), score = api.LMSGetValue("cmi.core.score.raw");
  let predicted = !question || +score >= 50, moved = false;
  const tellPredicted = () => {
    if (!predicted) tell("incomplete", 50);
    predicted = true;
  };
  const tellMoved = () => {
    if (predicted && !moved) tell("completed", 100);
    moved = predicted;
  };
  if (!score) tell("incomplete", 0);
  addEventListener("input", ({ target }) => (question?.contains(target) ? tellPredicted() : tellMoved()));
  addEventListener("click", ({ target }) => target.closest(".vmc-demo form button") && tellMoved());
})();
