/* Crops by their probability, in two rows, and the line right of which they are called shuttlecocks
   (book/figures/names.py). */
export const line = (given, [level, method, threshold], [plot]) => {
  const { chances, spread, truth } = given[level], mine = chances[method];
  const called = mine.map((chance) => chance > threshold);
  const right = called.filter((yes, i) => yes && truth[i]).length;
  const share = (all) => (right / all.filter(Boolean).length + 1e-9).toFixed(3).replace("NaN", "–");
  const words = `precision ${share(called)}, recall ${share(truth)}`;
  return [
    `Threshold ${threshold}: ${words}.`,
    mine.map((chance, i) => plot.mark("dot", truth[i] ? "blue" : "orange", [chance, spread[i]], 2)).join("") +
      plot.mark("line", "ink", [[threshold, -0.45], [threshold, 1.45]], 1.8) + plot.mark("words", "ink", plot.head, words, 6),
  ];
};
line.between = true; // at any values
