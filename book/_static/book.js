/* An equation wider than the page scrolls; then the keyboard must be able to reach it. */
(() => {
  const reach = () =>
    document.querySelectorAll("div.math").forEach((equation) =>
      equation.scrollWidth > equation.clientWidth
        ? equation.setAttribute("tabindex", "0")
        : equation.removeAttribute("tabindex"));
  addEventListener("load", () => window.MathJax?.startup?.promise.then(reach));
  addEventListener("resize", reach);
})();

/* A page shows the model's own code; what imports, draws and tabulates is folded. One switch in the
   header unfolds it all, and is remembered where the browser remembers. */
addEventListener("DOMContentLoaded", () => {
  const folded = document.querySelectorAll("details.hide.above-input");
  const header = document.querySelector(".article-header-buttons");
  if (!folded.length || !header) return;
  const button = document.createElement("button");
  button.className = "btn vmc-code";
  const show = (all) => {
    button.textContent = `Code: ${all ? "all" : "model"}`;
    button.setAttribute("aria-pressed", all);
    folded.forEach((cell) => (cell.open = all));
  };
  button.title = "Show the model's code alone, or all code of the page";
  button.addEventListener("click", () => {
    const all = button.getAttribute("aria-pressed") !== "true";
    show(all);
    vmcMemory.set("vmcCode", all ? "all" : "model");
  });
  show(vmcMemory.get("vmcCode") === "all");
  header.prepend(button);
});

/* Several folded cells in a row, up to one that shows something, are one fold: its line is the first one's. */
(() => {
  document.documentElement.classList.add("vmc-scripted");
  document.addEventListener("toggle", ({ target }) => {
    const cell = target.matches("details.hide") && target.closest(".cell.tag_hide-input:not(:has(> .cell_output))");
    const next = cell?.nextElementSibling;
    if (next?.matches(".tag_hide-input")) next.querySelector("details.hide").open = target.open;
  }, true);
})();

/* How sure a result is stands folded below its heading, until asked for or linked to; paper shows it. */
addEventListener("DOMContentLoaded", () =>
  document.querySelectorAll("section[id^='how-sure-are-we']").forEach((section) => {
    const heading = section.querySelector("h2, h3");
    const button = document.createElement("button");
    const open = (yes) => {
      section.classList.toggle("vmc-folded", !yes);
      button.setAttribute("aria-expanded", yes);
    };
    button.append(...[...heading.childNodes].filter((node) => !node.matches?.("a.headerlink")));
    heading.prepend(button);
    button.addEventListener("click", () => open(section.matches(".vmc-folded")));
    const asked = () => {
      const place = document.getElementById(decodeURIComponent(location.hash.slice(1)).split("?")[0]);
      if (place && section.contains(place)) { open(true); place.scrollIntoView(); }
    };
    addEventListener("hashchange", asked);
    open(false);
    asked();
  }));

/* Parts of the theme that a screen reader would meet without a name, or by another than is seen. */
addEventListener("load", () => {
  const side = document.querySelector(".bd-sidebar-primary");
  side?.setAttribute("role", "navigation");
  side?.setAttribute("aria-label", "Book");
  document.querySelectorAll(".bd-sidebar-primary summary").forEach((summary) => {
    const above = summary.closest("li").querySelector("a").textContent.trim();
    summary.setAttribute("aria-label", `Pages of ${above}`);
  });
  document.querySelectorAll(".search-button-field").forEach((b) => b.removeAttribute("aria-label"));
  document.querySelectorAll(".theme-switch-button").forEach((button) =>
    button.setAttribute("aria-label", "Color mode: Light, Dark or System Settings"));
});
