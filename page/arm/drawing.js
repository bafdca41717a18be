/* How the arm is drawn: in the scene that Python recorded (vmc_lib/show/arm.py), and on a plot. */
import { axesOf } from "../demo/axes.js";
import { viewOf } from "../demo/scene.js";
import { WholeBody } from "./whole.js";

/* Markup of marks on a plot, each point where `flat` says. */
const draw = (marks, measure, flat) =>
  marks.map(([kind, colour, points, ...look]) =>
    measure.mark(kind, colour, kind === "line" ? points.map(flat) : flat(points), ...look)).join("");

/* A magnifier beside a plot: a disc `at` a place of its axes, in which what is around the target is
   so many `times` as large. Below it a bar of 1 cm. */
class Lens {
  constructor(box, { at, radius, times }, { svg, measure }) {
    const [x, y] = at;
    const [[left, middle], [right]] = [[x - radius, y], [x + radius, y]].map(measure.place);
    const circle = `<circle cx="${(left + right) / 2}" cy="${middle}" r="${(right - left) / 2}"`;
    const bar = [x - 0.005 * times, x + 0.005 * times].map((end) => [end, y - 1.15 * radius]);
    svg.insertAdjacentHTML("beforeend", `<clipPath id="${box.id}-lens">${circle}/></clipPath>
      ${circle} fill="none" stroke="var(--vmc-grey)"/>
      ${measure.mark("line", "ink", bar, 2)}${measure.mark("words", "ink", [x, y - 1.15 * radius], "1 cm", -14)}
      <g clip-path="url(#${box.id}-lens)"></g>`);
    Object.assign(this, { at, times, measure, put: svg.lastElementChild });
  }

  show(marks, target) {
    const { at, times, measure, put } = this;
    const enlarge = (point) => at.map((middle, axis) => middle + times * (point[axis] - target[axis]));
    const shapes = marks.filter(([kind]) => kind !== "words");
    put.innerHTML = target ? draw(shapes, measure, enlarge) : "";
  }
}

export class Drawing {
  /* On each plot two axes are seen, as `given.views` says. */
  constructor(box, given) {
    this.balls = []; // where the scene's balls are, or nothing
    this.marks = []; // on the plot: [kind, colour, points in metres, size]
    this.view = viewOf(box.querySelector(".vmc-scene"));
    this.view.onstart = () => this.place(); // or the balls would be as recorded
    this.view.show(given.scene);
    if (given.still) this.showWhole(given);
    this.plots = [...box.querySelectorAll("svg[data-axes]")].map((svg, nth) => {
      const measure = axesOf(svg);
      const { left, right, bottom, top } = measure;
      const { width, height } = svg.viewBox.baseVal;
      svg.insertAdjacentHTML("beforeend", `<clipPath id="${box.id}-frame-${nth}"><rect
        x="${left * width}" width="${(right - left) * width}"
        y="${top * height}" height="${(bottom - top) * height}"/></clipPath>
        <g clip-path="url(#${box.id}-frame-${nth})"></g>`);
      return { svg, measure, axes: given.views[nth], put: svg.lastElementChild };
    });
    if (given.lens) this.lens = new Lens(box, given.lens, this.plots[0]);
  }

  /* Show the arm, { q, activation, joints }, and near by its `miss`, if it has come to an end; if `brief`,
     in 3-D alone. */
  show(seen, brief) {
    this.miss = seen.miss;
    this.view.pose(seen);
    this.place();
    if (brief) return;
    const marks = [["line", "ink", seen.joints, 5], ...this.marks];
    for (const { measure, axes, put } of this.plots)
      put.innerHTML = draw(marks, measure, (point) => axes.map((axis) => point[axis]));
    this.lens?.show(marks, this.focus);
  }

  /* The scene's arm is a whole one: what no recorded scene holds. */
  showWhole(given) {
    const { view } = this, makeBody = () => new WholeBody(view.viewer, given.muscles, given.bones);
    Object.assign(view, { anatomy: given, posed: given.still, makeBody });
  }

  place() {
    const { viewer, settings, closeUp } = this.view;
    if (!viewer) return;
    this.balls.forEach((position, i) => {
      const path = ["meshcat", "goal", `ball${i}`];
      viewer.set_property(path, "visible", Boolean(position));
      if (position) viewer.set_transform(path, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...position, 1]);
    });
    if (!settings.motion) return; // a whole arm
    Object.assign(settings, { miss: this.miss, target: this.balls[0] });
    closeUp.show();
  }
}
