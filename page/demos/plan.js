import * as planning from "../arm/planning.js";
import { signed, sum, times } from "../vectors.js";

/* A reach planned from four templates, where it ends, and one muscle's excitation as their sum. */
export const plan = ({ points, commands, ends, every }, target, [plane, time], place) => {
  const { chosen, weights } = planning.plan(target, { points });
  const end = ends[place];
  const miss = (1000 * Math.hypot(end[0] - target[0], end[1] - target[1])).toFixed(1);
  const parts = chosen.map((row, i) => times(weights[i], commands[row]));
  const mixed = parts[0].map((_, t) => sum(parts.map((part) => part[t])));
  const curve = (colour, values, width, name) =>
    time.mark("line", colour, values.map((value, t) => [t * every, value]), width, 0, name);
  const thread = (row, i) =>
    plane.mark("line", "blue", [target, points[row]], 10 * weights[i]) + plane.mark("dot", "blue", points[row], 3.5) +
    plane.mark("words", "ink", points[row], weights[i].toFixed(2), points[row][1] >= target[1] ? 7 : -14);
  const from = target.map((x) => signed(x, 3)).join(", ");
  return [
    `A target at ${from} m and the four templates that plan it; the hand ends ${miss} mm away. ` +
      "Beside it, one muscle's excitation as a weighted sum.",
    chosen.map(thread).join("") + plane.mark("line", "red", [target, end], 1) +
      plane.mark("ring", "green", target, 4) + plane.mark("dot", "red", end, 2) +
      plane.mark("words", "ink", plane.head, `the hand misses by ${miss} mm`, 6),
    parts.map((part, i) => curve("blue", part, 1, `template ${i + 1}`)).join("") + curve("red", mixed, 1.8, "their sum"),
  ];
};
