/* Tells a platform by SCORM 1.2 when the demo was moved: then it is completed. Without a platform it is silent. */
(() => {
  "use strict";

  const above = (frame) => frame.API ?? (frame.parent === frame ? null : above(frame.parent));
  let api;
  try {
    api = above(self) ?? (self.opener && above(self.opener));
  } catch {
    return; // a page of another host, which may not be looked into
  }
  if (`${api?.LMSInitialize("")}` !== "true") return;

  const tell = (status) => {
    if (api.LMSGetValue("cmi.core.lesson_status") === "completed") return; // and stays so
    api.LMSSetValue("cmi.core.lesson_status", status);
    api.LMSCommit("");
  };
  tell("incomplete");
  addEventListener("input", () => tell("completed"), { once: true });
  addEventListener("click", ({ target }) => target.closest("form button") && tell("completed"));
  addEventListener("pagehide", () => api.LMSFinish(""), { once: true });
})();
