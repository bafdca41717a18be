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
