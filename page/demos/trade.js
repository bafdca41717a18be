import { nms } from "../eye/boxes.js";
import { frame } from "./photo.js";

/* What non-maximum suppression keeps of the boxes [...box, score, the objects it holds] of some photos,
   the best first. */
const suppress = (shots, allowed) =>
  shots.flatMap((boxes, shot) =>
    nms(boxes, boxes.map((box) => box[4]), allowed).map((i) =>
      ({ box: boxes[i], shot, score: boxes[i][4], holds: boxes[i].slice(5) })),
  ).sort((a, b) => b.score - a.score);

/* A photo with the boxes above a threshold, and precision against recall (book/figures/trade.py). */
export const trade = ({ levels, shown, edge, paint }, [name, threshold, allowed], [, plot]) => {
  const level = levels[name], found = new Set();
  if (level.allowed !== allowed) Object.assign(level, { allowed, kept: suppress(level.shots, allowed) });
  let right = 0;
  const curve = level.kept.map(({ shot, holds }, n) => {
    right += holds.length > 0;
    for (const thing of holds) found.add(`${shot} ${thing}`);
    return [found.size / level.objects, right / (n + 1)];
  });
  const above = level.kept.filter(({ score }) => score > threshold);
  const [recall, precision] = curve[above.length - 1] ?? [0, 0];
  const rates = `precision ${(precision + 1e-9).toFixed(2)}, recall ${(recall + 1e-9).toFixed(2)}`; // halves up
  const here = above.filter(({ shot }) => shot === shown)
    .map(({ box, holds }) => frame(box.slice(0, 4), paint[holds.length ? "green" : "red"], edge));
  return [
    `${above.length} boxes are kept: ${rates}.`,
    `<image width="100%" height="100%" href="${level.image}"/>${here.join("")}`,
    plot.mark("line", "blue", curve, 1.8, 0, "precision") + plot.mark("dot", "red", [recall, precision], 4) +
      plot.mark("words", "ink", plot.head, rates, 6),
  ];
};
trade.between = true; // at any values
