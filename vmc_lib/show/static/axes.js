/* The axes of a plot that Python drew. Its `data-axes` say what they measure, and where in the
   picture they lie, as shares of its width and height. */
const vmcAxes = (svg) => {
  "use strict";

  const [x0, x1, y0, y1, left, right, bottom, top] = svg.dataset.axes.split(" ").map(Number);
  const [wide, high] = [(right - left) / (x1 - x0), (top - bottom) / (y1 - y0)];
  return {
    left, right, bottom, top,

    /* Where in the picture the place (x, y) is drawn, as shares of its width and height. */
    drawn: ([x, y]) => [left + wide * (x - x0), bottom + high * (y - y0)],

    /* The place (x, y) that the reader points at. */
    pointed: ({ clientX, clientY }) => {
      const box = svg.getBoundingClientRect();
      return [
        x0 + ((clientX - box.left) / box.width - left) / wide,
        y0 + ((clientY - box.top) / box.height - bottom) / high,
      ];
    },
  };
};
