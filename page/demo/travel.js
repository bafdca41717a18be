/* In a page of its own (kit/demos.py) a demo's equations are set with no fonts but the page's. */
import { fetchVendored } from "../vendored.js";

const setEquations = () =>
  self.renderMathInElement(document.body, {
    delimiters: [{ left: "\\(", right: "\\)", display: false }],
    output: "mathml",
  });
if (document.getElementById("katex.js")) fetchVendored("katex.js").then(setEquations);
