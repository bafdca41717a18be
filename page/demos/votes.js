import { degrees, dot, plus, signed, times } from "../vectors.js";

/* How neurons vote for a reach, each along the direction that it prefers, and their sum
   (book/figures/votes.py). */
export const votes = (_, [x, y, neurons, evenly], [plane]) => {
  const target = [x, y];
  const cast = Array.from({ length: neurons }, (_, i) => {
    const angle = 2 * Math.PI * (evenly ? i / neurons : (i / neurons) ** 2);
    const prefers = [Math.cos(angle), Math.sin(angle)];
    return times(dot(prefers, target), prefers);
  });
  const total = times(2 / neurons, cast.reduce(plus));
  const over = total[1] > y + 1e-6; // then its name is the upper one
  const along = dot(total, target) / (Math.hypot(...total) * Math.hypot(...target));
  const off = `${degrees(Math.acos(Math.min(1, along)), 0)} off`;
  const arrow = (colour, tip, width) => plane.mark("arrow", colour, [[0, 0], tip], width);
  const named = (colour, tip, words, above) =>
    arrow(colour, tip, 2) + plane.mark("words", colour, tip, words, above);
  const to = target.map((x) => signed(x, 2)).join(", ");
  return [
    `Votes of ${neurons} neurons for a reach to ${to}; their sum is ${off}.`,
    cast.map((vote) => arrow("grey", vote, 1)).join("") + named("green", target, "the reach", over ? -30 : 22) +
      named("red", total, "the sum", over ? 22 : -30) + plane.mark("words", "ink", [-1.5, 1.25], off, 0),
  ];
};
votes.between = true; // at any values
