/* Equations are set by KaTeX, where a page has it. */
export const setEquations = (element) => self.renderMathInElement?.(element, {
  delimiters: [{ left: "\\(", right: "\\)", display: false }, { left: "\\[", right: "\\]", display: true }],
  macros: { "\\bm": "\\boldsymbol{#1}" },
});
