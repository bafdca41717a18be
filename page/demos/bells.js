import { clip, dot, minus, plus, solve, sum, times } from "../vectors.js";

/* Granule cells along a line of targets, the Purkinje cell that sums them after some lessons, and how all
   answer at one place (book/figures/granule.py). */
export const bells = ({ lessons, uniform, ridge, line: [x, needed], edges, shown }, [width, count, place], [plot]) => {
  const some = lessons.slice(0, count), ends = some.map(([at]) => at);
  const [low, high] = [Math.min(...ends) - width, Math.max(...ends) + width];
  const centres = uniform.map((u) => low + (high - low) * u);
  const bell = (at, centre) => Math.exp(-((at - centre) ** 2) / (2 * width ** 2));
  const excite = (at) => centres.map((centre) => bell(at, centre));
  const active = ends.map(excite);
  const gram = active.map((row, i) => active.map((other, j) => dot(row, other) + (i === j) * ridge));
  const shares = solve(gram, some.map(([, aside]) => aside));
  const purkinje = active.map((row, k) => times(shares[k], row)).reduce(plus);
  const said = x.map((at) => dot(excite(at), purkinje));
  const off = minus(said, needed).map(Math.abs), now = x.indexOf(place);
  const clipToPlot = (y) => clip(y, ...edges);
  const curve = (colour, ys, size, name) => plot.mark("line", colour, x.map((at, i) => [at, ys[i]]), size, 0, name);
  const words = `off by ${(sum(off) / x.length).toFixed(2)} mm on average, here by ${off[now].toFixed(2)}`;
  const [floor] = edges;
  return [
    `After ${count} lessons, cells ${width} m wide: ${words}.`,
    centres.filter((_, j) => j % shown === 0)
      .map((centre) => curve("line", x.map((at) => floor - floor * bell(at, centre)), 1)).join("") +
      centres.map((at) => plot.mark("dot", "orange", [at, floor / 2], (3 * bell(place, at)).toFixed(2))).join("") +
      curve("grey", needed, 1.8, "what is needed") + curve("red", said.map(clipToPlot), 1.8, "the cells' sum") +
      some.map((lesson) => plot.mark("dot", "blue", lesson, 3)).join("") +
      plot.mark("line", "purple", [[place, clipToPlot(said[now])], [place, needed[now]]], 3) +
      plot.mark("words", "ink", plot.head, words, 6),
  ];
};
