/* What every page of words needs: its equations, its folds, names for a screen reader. */
import { address, hash } from "../demo/address.js";
import { memory } from "../demo/questions.js";
import { setEquations } from "./equations.js";

/* An equation or code wider than the page scrolls; then the keyboard must be able to reach it. The theme sees to
   code when a page opens, but not to that of a fold, which has no width until it is open. */
const makeReachable = (part) =>
  part.querySelectorAll("div.math, details[open] pre").forEach((wide) =>
    wide.scrollWidth > wide.clientWidth
      ? wide.setAttribute("tabindex", "0")
      : wide.removeAttribute("tabindex"));
addEventListener("DOMContentLoaded", () => setEquations(document.body));
for (const event of ["load", "resize"]) addEventListener(event, () => makeReachable(document));
document.addEventListener("toggle", ({ target }) => makeReachable(target), true);

/* A page shows the model's own code; what imports, draws and tabulates is folded. A box in the header
   shows it all, and is remembered where the browser remembers. */
addEventListener("DOMContentLoaded", () => {
  const folded = document.querySelectorAll("details.hide.above-input");
  const header = document.querySelector(".article-header-buttons");
  if (!folded.length || !header) return;
  const label = document.createElement("label");
  label.className = "vmc-code";
  label.title = "Otherwise the page shows the code of the model alone, not the code that draws and tabulates";
  label.innerHTML = '<input type="checkbox"> Show all code';
  const [box] = label.children;
  const show = () => folded.forEach((cell) => (cell.open = box.checked || cell.matches(":has(.vmc-lines)"))); // of the reader's
  box.checked = memory.get("vmcCode") === "all";
  box.addEventListener("change", () => {
    show();
    memory.set("vmcCode", box.checked ? "all" : "model");
  });
  show();
  folded.forEach((cell) => (cell.firstElementChild.title = "The code behind this"));
  header.prepend(label);
});

/* A run of folded cells is one fold: the mark of the first opens them all. */
document.addEventListener("toggle", ({ target }) => {
  const next = target.closest(".tag_hide-input")?.nextElementSibling;
  if (target.matches("details.hide") && next?.matches(".tag_hide-input"))
    next.querySelector("details.hide").open = target.open;
}, true);

/* An optional section stands folded below its heading until it is asked for, found or linked to; paper shows it. */
addEventListener("DOMContentLoaded", () =>
  document.querySelectorAll("section.vmc-optional").forEach((section) => {
    const heading = section.querySelector("h2, h3");
    const [button, inside] = ["button", "div"].map((name) => document.createElement(name));
    const open = (yes) => {
      if (yes) inside.removeAttribute("hidden");
      else inside.setAttribute("hidden", "until-found");
      button.setAttribute("aria-expanded", yes);
    };
    button.append(...[...heading.childNodes].filter((node) => !node.matches?.("a.headerlink")));
    heading.prepend(button);
    while (heading.nextSibling) inside.append(heading.nextSibling);
    heading.after(inside);
    button.addEventListener("click", () => open(inside.hasAttribute("hidden")));
    inside.addEventListener("beforematch", () => open(true));
    const openWhereLinked = () => {
      const place = document.getElementById(address()[0]);
      if (place && section.contains(place)) { open(true); place.scrollIntoView(); }
    };
    addEventListener("hashchange", openWhereLinked);
    addEventListener("load", () => inside.querySelector("span.highlighted") && open(true)); // by the book's search
    open(false);
    openWhereLinked();
  }));

/* What a link leads to is unfolded. */
const unfold = () => {
  const place = document.getElementById(hash()); // the key has no demos
  if (place?.matches("details")) place.open = true;
};
addEventListener("DOMContentLoaded", unfold);
document.addEventListener("click", ({ target }) => target.closest('a[href^="#"]') && setTimeout(unfold));

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
