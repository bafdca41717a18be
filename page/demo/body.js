/* The arm in a viewer's scene: arm26's bones (vendor/bones.js) and six muscles along their paths. The
   hand is drawn, not computed: it turns towards level, palm to the left, and can close. */
import { unzip } from "../vendored.js";
import { Muscles } from "./muscles.js";

const BONE = 0xe9dfca, GHOST = 0xa9b4c2, MARK = 0xf08c1a;
const SIDES = 10; // of a muscle
const BEND = 1.05; // rad: the most that the wrist turns to keep the hand level
const OPEN = 0.18, CLOSED = 0.62; // rad, at each joint of a finger

let unpacked;
export const bones = () => (unpacked ??= unzip(self.vmcBones).json());

/* How a bone looks, and one that is there to show where the others are. */
export const paints = () => {
  const { MeshLambertMaterial } = self.MeshCat.THREE;
  return {
    bone: new MeshLambertMaterial({ color: BONE }),
    ghost: new MeshLambertMaterial({ color: GHOST, transparent: true, opacity: 0.3 }),
  };
};

/* A bone's surface, as reproduce/render/bone_meshes.py packs it. */
export const surface = (points, faces) => {
  const { BufferAttribute, BufferGeometry } = self.MeshCat.THREE;
  const shape = new BufferGeometry();
  shape.setAttribute("position", new BufferAttribute(Float32Array.from(points, (x) => x / 1e4), 3));
  shape.setIndex(faces);
  shape.computeVertexNormals();
  return shape;
};

/* A lamp above and to the right, whose shadow of the arm falls on what lies below. */
export const light = (viewer) => {
  const { THREE } = self.MeshCat;
  for (const name of ["PointLightNegativeX", "PointLightPositiveX", "FillLight"])
    viewer.set_property(["Lights", name], "visible", false); // each costs time at every vertex
  viewer.set_property(["Lights", "AmbientLight", "<object>"], "intensity", 0.58);
  const lamp = new THREE.DirectionalLight(0xfff6ea, 0.55);
  lamp.position.set(0.56, 1.1, 0.7);
  lamp.target.position.set(0.26, -0.4, -0.02);
  lamp.castShadow = true;
  lamp.shadow.mapSize.set(512, 512);
  viewer.renderer.shadowMap.type = THREE.PCFShadowMap; // a third cheaper than the softer one
  lamp.shadow.bias = -0.002;
  Object.assign(lamp.shadow.camera, { left: -0.36, right: 0.36, top: 0.36, bottom: -0.36, near: 0.2, far: 3 });
  viewer.scene_tree.find(["meshcat", "arm"]).object.add(lamp, lamp.target);
};

export class Body {
  /* In a meshcat viewer, by an Anatomy; `bones` as they are in the file. */
  constructor(viewer, anatomy, bones) {
    const THREE = (this.THREE = self.MeshCat.THREE);
    Object.assign(this, { viewer, anatomy, bones, hand: new THREE.Group() });
    this.bodies = [0, 1, 2].map(() => new THREE.Group());
    this.trunk = this.bodies[0]; // the others' frames are given in its own
    this.trunk.add(this.bodies[1], this.bodies[2]);
    this.bodies[2].add(this.hand);
    this.hand.position.set(...bones.wrist);
    this.level = this.levelHand();
    this.addBones();
    this.muscles = new Muscles(viewer, anatomy.muscles.length, this.trunk, SIDES);
    const seen = { color: MARK, depthTest: false, transparent: true }; // through all else
    this.mark = new THREE.Mesh(new THREE.SphereGeometry(0.006, 16, 12), new THREE.MeshBasicMaterial(seen));
    this.mark.renderOrder = 2;
    this.path = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(seen));
    this.path.frustumCulled = false;
    this.trunk.add(this.mark);
    light(viewer);
    viewer.scene_tree.find(["meshcat", "arm"]).object.add(this.trunk);
  }

  /* How a hand is turned whose fingers point forward and whose palm faces left and down. */
  levelHand() {
    const { THREE, bones } = this;
    const basis = (along, facing) => {
      const [a, f] = [along, facing].map((v) => new THREE.Vector3(...v).normalize());
      f.addScaledVector(a, -f.dot(a)).normalize();
      return new THREE.Matrix4().makeBasis(a, f, a.clone().cross(f));
    };
    const level = basis([1, -0.1, 0], [-0.06, -0.55, -0.83]);
    const turn = level.multiply(basis(bones.along, bones.facing).transpose());
    return new THREE.Quaternion().setFromRotationMatrix(turn);
  }

  addBones() {
    const { THREE } = this;
    const { bone, ghost } = paints();
    const trunk = { ribs: ghost, spine: ghost, girdle: bone };
    const groups = { humerus: this.bodies[1], forearm: this.bodies[2], palm: this.hand };
    const { parts, wrist } = this.bones;
    this.fingers = [];
    for (const [name, { points, faces, on, pivot, axis }] of Object.entries(parts)) {
      const mesh = new THREE.Mesh(surface(points, faces), trunk[name] ?? bone);
      mesh.castShadow = Boolean(on) || ["forearm", "palm"].includes(name); // what is over the table
      const origin = name === "palm" ? wrist : pivot; // where it turns
      if (origin) mesh.position.set(...origin).negate();
      if (on) {
        const group = (groups[name] = new THREE.Group());
        const before = new THREE.Vector3(...(parts[on].pivot ?? wrist));
        group.position.set(...pivot).sub(before);
        groups[on].add(group);
        this.fingers.push({ group, axis: new THREE.Vector3(...axis) });
      }
      (groups[name] ?? this.trunk).add(mesh);
    }
  }

  /* The wrist's path: of its points those are seen that the movement has passed. */
  draw(points) {
    this.path.geometry.setFromPoints(points.map((point) => new this.THREE.Vector3(...point)));
    this.viewer.scene_tree.find(["meshcat", "goal"]).object.add(this.path);
  }

  get hasGoal() {
    const { children } = this.viewer.scene_tree.find(["meshcat", "goal"]);
    return Object.keys(children).some((name) => !name.startsWith("<"));
  }

  /* Take a posture: { q, activation, turn, grasp }, angles in radians, the rest in 0 … 1; so many
     points of the path are passed. */
  pose({ q, activation, turn = 0, grasp = 0 }, passed) {
    const { THREE, anatomy } = this;
    this.path.geometry.setDrawRange(0, Math.ceil(passed) + 1);
    const frames = anatomy.frames(q);
    frames.forEach(({ rows, origin }, i) => {
      if (!i) return;
      const [[a, b, c], [d, e, f], [g, h, k]] = rows;
      this.bodies[i].matrixAutoUpdate = false;
      this.bodies[i].matrix.set(a, b, c, origin[0], d, e, f, origin[1], g, h, k, origin[2], 0, 0, 0, 1);
    });
    const [x, z] = anatomy.trunk;
    const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    this.trunk.rotation.y = turn;
    this.trunk.position.set(x - cos * x - sin * z, 0, z + sin * x - cos * z);
    const forearm = new THREE.Quaternion().setFromRotationMatrix(this.bodies[2].matrix);
    const turned = forearm.clone().rotateTowards(this.level, BEND);
    this.hand.quaternion.copy(forearm.invert()).multiply(turned);
    for (const { group, axis } of this.fingers)
      group.quaternion.setFromAxisAngle(axis, OPEN + (CLOSED - OPEN) * grasp);
    const wrist = anatomy.place(frames[2], anatomy.hand);
    this.mark.position.set(...wrist.map((c, i) => c + anatomy.beyond[i]));
    this.mark.visible = this.hasGoal; // what is to meet it: the hand's own place depends on how far the wrist bends
    const paths = anatomy.paths(q, frames);
    this.muscles.pose(paths.map((path, k) => anatomy.belly(path, anatomy.muscles[k])), activation);
    this.viewer.set_dirty();
  }
}
