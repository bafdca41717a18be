/* Equations are set by KaTeX, where a page has it. */
export const setEquations = (element) => self.renderMathInElement?.(element, {
  delimiters: [{ left: "\\(", right: "\\)", display: false }, { left: "\\[", right: "\\]", display: true }],
  maxSize: 20, // em: no rule covers the page
  macros: { "\\bm": "\\boldsymbol{#1}" },
});
