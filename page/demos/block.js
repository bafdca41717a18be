import { sum } from "../vectors.js";

/* A block of probabilistic max-pooling: at most one of its units is on (book/figures/crbm.py). */
export const block = (_, drives, [plot]) => {
  const total = 1 + sum(drives.map(Math.exp));
  const chances = [...drives.map((drive) => Math.exp(drive) / total), 1 / total];
  const words = `pooled unit on: ${(1 - 1 / total).toFixed(3)}`;
  return [
    `Chances: ${chances.map((chance) => chance.toFixed(2)).join(", ")}; ${words}.`,
    chances.map((chance, i) =>
      plot.mark("area", i < 4 ? "blue" : "grey", [[i - 0.4, 0], [i - 0.4, chance], [i + 0.4, chance], [i + 0.4, 0]]) +
      plot.mark("words", "ink", [i, chance], chance.toFixed(2), 3)).join("") +
      plot.mark("words", "ink", plot.head, words, 6),
  ];
};
block.between = true; // at any values
