/* A slide that is too tall for its room is drawn smaller until it fits: a demo's controls stand below its
   pictures, or beside them, whichever leaves these larger; a scene has them always beside it. */
const fits = (slide, content, least) => {
  for (let zoom = 1; zoom > least; zoom -= 0.05) {
    content.style.zoom = zoom;
    if (slide.scrollHeight <= slide.clientHeight + 1) return true;
  }
  return false;
};

const area = (content) => [...content.querySelectorAll(".vmc-picture > :is(svg, img)")]
  .map((picture) => picture.getBoundingClientRect())
  .reduce((sum, { width, height }) => sum + width * height, 0);

const fit = (slide) => {
  const content = slide?.querySelector(":scope > .fit");
  if (!content) return;
  const fittedArea = (where, least) => {
    content.classList.toggle("beside", where === "beside");
    return fits(slide, content, least) ? area(content) : -1;
  };
  const below = content.querySelector(".vmc-scene") ? -1 : fittedArea("below", 0.8);
  if (fittedArea("beside", 0.4) <= below) fittedArea("below", 0.8);
};

const fitCurrent = () => fit(Reveal.getCurrentSlide());

/* Paper has all answers open, and every slide as small as that needs; each is measured alone. */
const openAll = () => {
  document.documentElement.classList.add("print-pdf"); // reveal.js' own paper lets slides flow
  const current = Reveal.getCurrentSlide();
  for (const answer of document.querySelectorAll(".fit details")) answer.open = true;
  current.classList.remove("present");
  for (const slide of document.querySelectorAll(".slides > section")) {
    const { display } = slide.style;
    slide.classList.add("present");
    slide.style.display = "";
    fit(slide);
    slide.classList.remove("present");
    slide.style.display = display;
  }
  current.classList.add("present");
};

/* What a presenter's clicker sends turns the page (or darkens the room) wherever the focus is; so do the
   arrows and the space bar, but where the control that has the focus needs them. */
const TURNS = {
  PageDown: "next", PageUp: "prev", ArrowRight: "next", ArrowLeft: "prev", " ": "next", ".": "togglePause", b: "togglePause",
};
const FIELDS = "select, textarea, input:not([type=range], [type=radio], [type=checkbox])";
const ARROWS = `${FIELDS}, [type=range], [type=radio]`;
const NEEDED = { ArrowRight: ARROWS, ArrowLeft: ARROWS, " ": `${FIELDS}, [type=radio], [type=checkbox], button, summary` };
const needs = ({ target, key }) => !key.startsWith("Page") && target.matches(NEEDED[key] ?? FIELDS);

addEventListener("keydown", (event) => {
  const turn = TURNS[event.key];
  if (!turn || needs(event) || event.shiftKey || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault(); // no slider moves
  event.stopImmediatePropagation();
  Reveal[turn]();
}, true);

addEventListener("DOMContentLoaded", () => {
  Reveal.on("ready", () => Reveal.configure({ keyboardCondition: (event) => !needs(event) }));
  const heights = new ResizeObserver(() => {
    const slide = Reveal.getCurrentSlide();
    if (slide.scrollHeight > slide.clientHeight + 1) fitCurrent();
  });
  for (const content of document.querySelectorAll(".fit")) heights.observe(content);
  for (const event of ["ready", "slidechanged", "resize"]) Reveal.on(event, fitCurrent);
  addEventListener("beforeprint", openAll);
});
