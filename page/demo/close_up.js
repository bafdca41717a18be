/* The miss, made visible: where a movement ends, a picture in the scene's corner shows hand and target
   from the side, six times nearer, and a ruler from the target as long as the miss. What the hand then does
   to the shuttlecock, lift it or tip it over, is an illustration: the model ends with the hold. */
import { minus, plus, turnAboutY } from "../vectors.js";

const HALF = 0.032; // m from the middle to the edge of the close-up
const NEAR = 0.5; // m: where its eye stands
const FLEX = 0.3, ROLL = 0.7, TOPPLE = 1.3; // rad: the elbow lifts, what lies rolls, what stands falls
const LENGTH = 0.085, RIM = 0.033; // m, of a shuttlecock: vmc_lib/show/props.py, held equal by a test
const SPAN = (1000 * HALF).toFixed(0);

/* The ruler as SVG, in mm round the target, y down: from there towards (x, y), as long as the miss. */
export const ruler = (mm, [x, y]) => {
  const angle = (Math.atan2(y, x) * 180) / Math.PI;
  const ticks = Array.from({ length: Math.floor(mm) + 1 }, (_, i) => `M${i} 0v${i % 5 ? 1.2 : 2.2}`).join("");
  return `<circle r="${mm}"/><g transform="rotate(${angle})"><path d="M0 0H${mm}${ticks}M${mm} 0v2.2"/></g>
    <circle class="vmc-target" r="1"/><circle class="vmc-end" cx="${x}" cy="${y}" r=".8"/>
    <text y="${SPAN - 3}">${mm.toFixed(1)} mm</text>`;
};

export class CloseUp {
  constructor(view, canvas) {
    Object.assign(this, { view, canvas, after: 0 });
    this.picture = document.createElement("canvas");
    this.sheet = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    this.sheet.setAttribute("viewBox", `-${SPAN} -${SPAN} ${2 * SPAN} ${2 * SPAN}`);
    this.box = document.createElement("div");
    this.box.className = "vmc-close-up";
    this.box.setAttribute("aria-hidden", "true"); // the panel says the same
    this.box.append(this.picture, this.sheet);
    this.camera = new self.MeshCat.THREE.OrthographicCamera(-HALF, HALF, HALF, -HALF, NEAR - 0.06, 3);
  }

  /* What the movement leads to, once it has ended; nothing before. */
  get miss() {
    const { miss } = this.view.settings;
    return miss && this.view.time >= this.view.duration ? miss : null;
  }

  /* Draw the ruler, or take it away; and note what has become of the shuttlecock, from 0 to 1. */
  show(after = 0) {
    const { miss, view } = this;
    this.after = miss ? after : 0;
    if (!miss) return this.box.remove();
    if (!this.box.isConnected) this.canvas.append(this.box);
    const [x, y] = turnAboutY(minus(miss.end, view.settings.target), -this.turn);
    const words = ruler(miss.mm, [1000 * x, -1000 * y]);
    if (this.drawn !== words) this.sheet.innerHTML = this.drawn = words;
  }

  /* How far the trunk has turned in the end, rad. */
  get turn() {
    const { miss, motion } = this.view.settings;
    return miss.turn ?? motion.turn.at(-1);
  }

  /* Photograph the end, before the whole is rendered: only bones and shuttlecock. */
  render(viewer) {
    const { view, camera, picture } = this, { renderer, scene, scene_tree } = viewer;
    if (!this.miss || this.after || !view.body) return;
    const from = turnAboutY(plus(view.anatomy.beyond, [0, 0, NEAR]), this.turn);
    camera.position.set(...plus(view.settings.target, from));
    camera.rotation.set(0, this.turn, 0);
    const goal = scene_tree.find(["meshcat", "goal"]), { path, mark } = view.body;
    const others = Object.entries(goal.children).filter(([name]) => name !== "shuttlecock" && !name.startsWith("<"));
    const hidden = [path, mark, ...others.map(([, { object }]) => object)].filter((thing) => thing.visible);
    hidden.forEach((thing) => (thing.visible = false));
    const size = this.box.clientWidth, ratio = renderer.getPixelRatio();
    renderer.setViewport(0, 0, size, size);
    renderer.render(scene, camera);
    picture.width = picture.height = size * ratio;
    const top = renderer.domElement.height - size * ratio; // GL counts from below
    picture.getContext("2d").drawImage(renderer.domElement, 0, top, size * ratio, size * ratio, 0, 0, size * ratio, size * ratio);
    hidden.forEach((thing) => (thing.visible = true));
    const { width, height } = renderer.domElement;
    renderer.setViewport(0, 0, width / ratio, height / ratio);
  }

  /* Put the shuttlecock back: another scene may move it. */
  putBack() {
    if (!this.rest) return;
    const { thing, position, quaternion } = this.rest;
    thing.position.copy(position);
    thing.quaternion.copy(quaternion);
    this.rest = null;
  }

  /* The pose in which the hand lifts the shuttlecock so far; and the shuttlecock, moved. */
  lift(pose) {
    const { miss, after, view } = this;
    const thing = view.viewer.scene_tree.find(["meshcat", "goal", "shuttlecock"]).object;
    this.putBack();
    if (!miss || !after) return pose;
    this.rest = { thing, position: thing.position.clone(), quaternion: thing.quaternion.clone() };
    const share = after * after * (3 - 2 * after);
    if (!miss.lifted) return this.tip(thing, share), pose;
    const lifted = { ...pose, q: [pose.q[0], pose.q[1] + FLEX * share] };
    const [from, to] = [pose, lifted].map(({ q, turn }) => view.anatomy.wrist(q, turn));
    thing.position.add({ x: to[0] - from[0], y: to[1] - from[1], z: to[2] - from[2] });
    return lifted;
  }

  /* Pushed on: what lies rolls about its cork, what stands topples over its rim. */
  tip(thing, share) {
    const { Vector3, Quaternion } = self.MeshCat.THREE;
    const { miss, view } = this, up = new Vector3(0, 1, 0);
    const along = new Vector3(...view.settings.target.map((t, i) => t - miss.end[i])).setY(0).normalize();
    const base = new Vector3(0, LENGTH, 0).applyQuaternion(thing.quaternion).add(thing.position);
    const [axis, angle, pivot] = miss.stands
      ? [up.cross(along), TOPPLE, base.addScaledVector(along, RIM)]
      : [up, ROLL, thing.position.clone()];
    const turn = new Quaternion().setFromAxisAngle(axis, angle * share);
    thing.position.sub(pivot).applyQuaternion(turn).add(pivot);
    thing.quaternion.premultiply(turn);
  }
}

export { LENGTH, RIM };
