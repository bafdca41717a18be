/* The whole arm in a viewer's scene: its bones, and its muscles along the ways that MuJoCo finds. */
import { Anatomy } from "../demo/anatomy.js";
import { light, paints, surface } from "../demo/body.js";
import { Muscles } from "../demo/muscles.js";

const SIDES = 6; // of a muscle: there are many, and each costs time
const { belly } = Anatomy.prototype;

export class WholeBody {
  /* `muscles`: what the belly of each is drawn by; `bones`: their surfaces in the bodies' frames. */
  constructor(viewer, muscles, bones) {
    const { THREE } = self.MeshCat;
    const { bone, ghost } = paints();
    this.bones = Object.entries(bones).map(([name, { points, faces }]) =>
      new THREE.Mesh(surface(points, faces), name === "world" ? ghost : bone));
    for (const mesh of this.bones) mesh.matrixAutoUpdate = false;
    const arm = viewer.scene_tree.find(["meshcat", "arm"]).object.add(...this.bones);
    light(viewer);
    Object.assign(this, { viewer, drawn: muscles });
    this.muscles = new Muscles(viewer, muscles.length, arm, SIDES);
  }

  /* What an arm's `look` saw, and its activation. */
  pose({ frames, ways, activation }) {
    frames.forEach(([a, b, c, d, e, f, g, h, k, x, y, z], i) =>
      this.bones[i].matrix.set(a, b, c, x, d, e, f, y, g, h, k, z, 0, 0, 0, 1));
    this.muscles.pose(ways.map((way, k) => belly(way, this.drawn[k])), activation);
    this.viewer.set_dirty();
  }
}
