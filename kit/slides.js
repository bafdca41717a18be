/* A slide that is too tall for its room is drawn smaller until it fits: first a little, then with the
   demo's controls beside its pictures. */
const fits = (slide, content, least) => {
  for (let zoom = 1; zoom > least; zoom -= 0.05) {
    content.style.zoom = zoom;
    if (slide.scrollHeight <= slide.clientHeight + 1) return true;
  }
  return false;
};

const fit = () => {
  const slide = Reveal.getCurrentSlide();
  const content = slide?.querySelector(":scope > .fit");
  if (!content) return;
  content.classList.remove("beside");
  if (fits(slide, content, 0.8)) return;
  content.classList.add("beside");
  fits(slide, content, 0.4);
};

addEventListener("DOMContentLoaded", () => {
  const heights = new ResizeObserver(() => {
    const slide = Reveal.getCurrentSlide();
    if (slide.scrollHeight > slide.clientHeight + 1) fit();
  });
  for (const content of document.querySelectorAll(".fit")) heights.observe(content);
  for (const event of ["ready", "slidechanged", "resize"]) Reveal.on(event, fit);
});
