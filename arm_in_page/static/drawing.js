/* How the arm is drawn: in the scene that Python recorded (vmc_lib/show/arm.py), and on a plot. */
const vmcDrawing = (() => {
  "use strict";

  class Drawing {
    /* On each plot two axes are seen, as `given.views` says. */
    constructor(box, given) {
      this.balls = []; // where the scene's balls are, or nothing
      this.marks = []; // on the plot: [kind, colour, points in metres, size]
      this.view = vmcScene(box.querySelector(".vmc-scene"));
      this.view.onstart = () => this.start(given);
      this.view.show(given.scene);
      if (given.still) Object.assign(this.view, { anatomy: given, posed: given.still });
      this.plots = [...box.querySelectorAll("svg[data-axes]")].map((svg, nth) => {
        const measure = vmcAxes(svg);
        const { left, right, bottom, top } = measure;
        const { width, height } = svg.viewBox.baseVal;
        svg.insertAdjacentHTML("beforeend", `<clipPath id="${box.id}-frame-${nth}"><rect
          x="${left * width}" width="${(right - left) * width}"
          y="${top * height}" height="${(bottom - top) * height}"/></clipPath>
          <g clip-path="url(#${box.id}-frame-${nth})"></g>`);
        return { svg, measure, axes: given.views[nth] };
      });
    }

    /* Show the arm, { q, activation, joints }; if `brief`, in 3-D alone. */
    show(seen, brief) {
      this.view.pose(seen);
      this.place();
      if (brief) return;
      const marks = [["line", "ink", seen.joints, 5], ...this.marks];
      for (const { svg, measure, axes } of this.plots) {
        const flat = (point) => axes.map((axis) => point[axis]);
        const drawn = marks.map(([kind, colour, points, size]) =>
          measure.mark(kind, colour, kind === "line" ? points.map(flat) : flat(points), size));
        svg.lastElementChild.innerHTML = drawn.join("");
      }
    }

    /* The viewer is there: draw in it what no recorded scene holds. */
    start({ still, muscles, bones }) {
      const { view } = this;
      if (still) {
        view.body = new vmcWhole.Body(view.viewer, muscles, bones);
        view.pose(view.posed);
      }
      this.place(); // or the balls would be as recorded
    }

    place() {
      const { viewer } = this.view;
      if (!viewer) return;
      this.balls.forEach((position, i) => {
        const path = ["meshcat", "goal", `ball${i}`];
        viewer.set_property(path, "visible", Boolean(position));
        if (position) viewer.set_transform(path, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...position, 1]);
      });
    }
  }

  return { Drawing };
})();
