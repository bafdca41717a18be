/* How the arm is drawn: in the scene that Python recorded (vmc_lib/show/arm.py), and on a plot. */
const vmcDrawing = (() => {
  "use strict";

  class Drawing {
    constructor(box, given) {
      this.balls = []; // where the scene's balls are, or nothing
      this.marks = []; // on the plot: [kind, colour, points in metres, size]
      this.view = vmcScene(box.querySelector(".vmc-scene"));
      this.view.onstart = () => this.place(); // or the balls would be as recorded
      this.view.show(given.scene);
      this.plot = box.querySelector("svg[data-axes]");
      this.axes = vmcAxes(this.plot);
      const { left, right, bottom, top } = this.axes;
      const { width, height } = this.plot.viewBox.baseVal;
      this.plot.insertAdjacentHTML("beforeend", `<clipPath id="${box.id}-frame"><rect
        x="${left * width}" width="${(right - left) * width}"
        y="${top * height}" height="${(bottom - top) * height}"/></clipPath>
        <g clip-path="url(#${box.id}-frame)"></g>`);
    }

    /* Show the arm, { q, activation, joints }; if `brief`, in 3-D alone. */
    show(seen, brief) {
      this.view.pose(seen);
      this.place();
      if (brief) return;
      this.plot.lastElementChild.innerHTML =
        [["line", "ink", seen.joints, 5], ...this.marks].map((mark) => this.axes.mark(...mark)).join("");
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
