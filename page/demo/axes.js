/* The axes of a plot that Python drew. Its `data-axes` say what they measure, and where in the
   picture they lie, as shares of its width and height. */
import { clip } from "../vectors.js";

export const axesOf = (svg) => {
  const [x0, x1, y0, y1, left, right, bottom, top] = svg.dataset.axes.split(" ").map(Number);
  const [wide, high] = [(right - left) / (x1 - x0), (top - bottom) / (y1 - y0)];
  const { width, height } = svg.viewBox.baseVal;

  /* Where in the picture the place (x, y) is drawn, as shares of its width and height. */
  const shareOf = ([x, y]) => [left + wide * (x - x0), bottom + high * (y - y0)];

  const put = (point) => {
    const [right, down] = shareOf(point);
    return [(width * right).toFixed(1), (height * down).toFixed(1)];
  };

  /* An arrow's head: one side, its tip again, the other side. */
  const arrowhead = (points) => {
    const [[x0, y0], [x, y]] = points.slice(-2).map((point) => put(point).map(Number));
    const side = (turn) => {
      const angle = Math.atan2(y - y0, x - x0) + turn;
      return [x - 6 * Math.cos(angle), y - 6 * Math.sin(angle)].map((n) => n.toFixed(1));
    };
    return [side(0.45), [x, y], side(-0.45)];
  };

  return {
    left, right, bottom, top, shareOf, place: (point) => put(point).map(Number),
    head: [(x0 + x1) / 2, y1], // where a title stands

    /* How far along axis 0 or 1 a value lies, 0 to 1. */
    share: (value, axis, log) => {
      const [low, high, at] = [...(axis ? [y0, y1] : [x0, x1]), value].map(log ? Math.log : Number);
      return (at - low) / (high - low);
    },

    /* Markup of a mark in a named colour: a "line" or an "arrow" through points of some width, an "area"
       within points, a "ring" or a "dot" of some radius, or "words" so far above a point, and
       [up, aside] of it where both are given. A line with a name is a curve, which can be heard. */
    mark: (kind, colour, points, size, above, name) => {
      const paint = `var(--vmc-${colour})`;
      if (kind === "line" || kind === "arrow")
        return `<polyline points="${[...points.map(put), ...(kind === "arrow" ? arrowhead(points) : [])].join(" ")}"
          ${name ? `data-curve="${name}"` : ""} fill="none" stroke="${paint}" stroke-width="${size}" stroke-opacity=".7" stroke-linecap="round"/>`;
      if (kind === "area") return `<polygon points="${points.map(put).join(" ")}" fill="${paint}"/>`;
      const [x, y] = put(points);
      if (kind === "words") { // whole, at the picture's edge too
        const half = 3 * size.length, [up, aside = 0] = [above].flat();
        return `<text x="${clip(+x + aside, half, width - half)}" y="${y - up}" fill="${paint}" font-size="10"
          text-anchor="middle">${size}</text>`;
      }
      const look = kind === "ring" ? `fill="none" stroke-width="2" stroke` : "fill";
      return `<circle cx="${x}" cy="${y}" r="${size}" ${look}="${paint}"/>`;
    },

    /* The place (x, y) that the reader points at. */
    placeAt: ({ clientX, clientY }) => {
      const box = svg.getBoundingClientRect();
      return [
        x0 + ((clientX - box.left) / box.width - left) / wide,
        y0 + ((clientY - box.top) / box.height - bottom) / high,
      ];
    },
  };
};
