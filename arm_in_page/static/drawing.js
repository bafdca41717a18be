/* How the arm is drawn: in the scene that Python recorded (vmc_lib/show/arm.py), and on a plot. */
const vmcDrawing = (() => {
  "use strict";

  /* Transforms as meshcat takes them, column by column: something at a place, in its size … */
  const place = ([x, y, z], size) => [size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, x, y, z, 1];
  const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];

  /* … and a unit cylinder (centred, along y), laid from one point to another. */
  const span = (from, to, radius) => {
    const along = to.map((x, i) => x - from[i]);
    const length = Math.hypot(...along);
    if (length < 1e-9) return place(from, 1e-6);
    const sizes = along.map(Math.abs);
    const least = sizes.indexOf(Math.min(...sizes));
    const across = cross(along, [0, 1, 2].map((i) => +(i === least)));
    const side = across.map((x) => (radius * x) / Math.hypot(...across));
    const other = cross(side, along.map((x) => x / length));
    const middle = from.map((x, i) => (x + to[i]) / 2);
    return [...side, 0, ...along, 0, ...other, 0, ...middle, 1];
  };

  class Drawing {
    constructor(box, given) {
      this.given = given;
      this.balls = []; // where the scene's balls are, or nothing
      this.marks = []; // on the plot: [kind, colour, points in metres, size]
      this.view = vmcScene(box.querySelector(".vmc-scene"));
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

    /* Show the arm's geometry with each muscle's activation and pull; if `brief`, in 3-D alone. */
    show(seen, brief) {
      this.seen = seen;
      this.draw();
      if (brief) return;
      this.plot.lastElementChild.innerHTML =
        [["line", "ink", seen.joints, 5], ...this.marks].map((mark) => this.mark(...mark)).join("");
    }

    /* A viewer that comes back to life shows the scene as recorded: draw once more. */
    refresh() {
      if (this.view.viewer && this.view.viewer !== this.drawn) this.draw();
    }

    draw() {
      const { viewer } = this.view;
      if (viewer !== this.drawn) this.prepare(viewer);
      if (!viewer) return;
      const { joints, muscles, activation, pull } = this.seen;
      const { radius, F0 } = this.given;
      this.bends.count = this.stretches.count = 0;
      this.tube(joints, radius.bone, this.bone);
      muscles.forEach((line, k) => {
        const share = Math.min(Math.max(pull[k] / F0[k], 0), 1);
        const heat = this.cold.clone().lerp(this.hot, activation[k]);
        this.tube(line, radius.thin + (radius.thick - radius.thin) * share, heat);
      });
      for (const mesh of [this.bends, this.stretches])
        mesh.instanceMatrix.needsUpdate = mesh.instanceColor.needsUpdate = true;
      viewer.set_transform(["meshcat", "arm", "hand"], place(joints[2], 1));
      this.balls.forEach((position, i) => {
        viewer.set_property(["meshcat", `ball${i}`], "visible", Boolean(position));
        if (position) viewer.set_transform(["meshcat", `ball${i}`], place(position, 1));
      });
      viewer.set_dirty();
    }

    /* In place of the recorded tubes, two meshes of many instances: they are quick to move. */
    prepare(viewer) {
      this.drawn = viewer;
      if (!viewer) return;
      const { THREE } = self.MeshCat;
      const [bone, cold, hot] = this.given.colours.map((hex) => new THREE.Color(hex));
      const add = (shape) => {
        const mesh = new THREE.InstancedMesh(shape, new THREE.MeshLambertMaterial(), 100);
        mesh.frustumCulled = false;
        viewer.scene_tree.find(["meshcat", "live"]).object.add(mesh);
        return mesh;
      };
      const bends = add(new THREE.SphereGeometry(1, 10, 8));
      const stretches = add(new THREE.CylinderGeometry(1, 1, 1, 10));
      Object.assign(this, { bone, cold, hot, bends, stretches, matrix: new THREE.Matrix4() });
      for (const name of ["bones", ...this.given.muscles])
        viewer.set_property(["meshcat", "arm", name], "visible", false);
    }

    tube(line, radius, colour) {
      const put = (mesh, transform) => {
        mesh.setMatrixAt(mesh.count, this.matrix.fromArray(transform));
        mesh.setColorAt(mesh.count++, colour);
      };
      line.forEach((point, i) => {
        put(this.bends, place(point, radius));
        if (i) put(this.stretches, span(line[i - 1], point, radius));
      });
    }

    mark(kind, colour, points, size) {
      const { width, height } = this.plot.viewBox.baseVal;
      const put = (point) => {
        const [right, down] = this.axes.drawn(point);
        return [(width * right).toFixed(1), (height * down).toFixed(1)];
      };
      const paint = `var(--vmc-${colour})`;
      if (kind === "line")
        return `<polyline points="${points.map(put).join(" ")}" fill="none" stroke="${paint}"
          stroke-width="${size}" stroke-opacity=".7" stroke-linecap="round"/>`;
      const [x, y] = put(points);
      const look = kind === "ring" ? `fill="none" stroke-width="2" stroke` : "fill";
      return `<circle cx="${x}" cy="${y}" r="${size}" ${look}="${paint}"/>`;
    }
  }

  return { Drawing, place, span };
})();
