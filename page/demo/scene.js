/* Shows recorded meshcat scenes. A scene is a list of "type path property|base64" messages, and of a
   few that meshcat has no command for, "name|JSON": camera, anatomy, motion, target, end, miss. Given the next
   scene, a view sends its viewer only what differs. The viewer is fetched (page/vendored.js) when the page
   is idle, or a scene comes into sight. */
import { clip, minus } from "../vectors.js";
import { fetchVendored, once } from "../vendored.js";
import { Anatomy, moment } from "./anatomy.js";
import { Body, bones as unpackBones } from "./body.js";
import { CloseUp } from "./close_up.js";
import { addPointer } from "./scene_pointer.js";

const MOST_LIVE = 6; // browsers keep few WebGL contexts: the scene unseen longest becomes a still
const live = new Set(); // in the order in which they came into sight
const views = new Map();

const COMMANDS = new Set(["set_transform", "set_object", "set_property", "delete"]); // others run code, or save files
const NO_WEBGL = "This browser draws no 3-D picture: it has no WebGL, or it is switched off.";
const WIDE = 1.15; // width to height: in a narrower picture the eye steps back

/* A scene brings its textures along: whatever it names, no host is asked for it, with the reader's session. */
const askNoHost = ({ ImageLoader: { prototype } }) => {
  const { load } = prototype;
  prototype.load = function (address, ...rest) {
    const own = /^data:/.test(this.manager.resolveURL(address));
    return load.call(this, own ? address : "data:,", ...rest);
  };
};

let bones;
const fetchAll = once(async () => {
  if (!self.MeshCat) {
    await fetchVendored("meshcat.js");
    askNoHost(self.MeshCat.THREE);
  }
  if (!self.vmcBones) await fetchVendored("bones.js");
  bones = await unpackBones();
});
const load = () => fetchAll().catch(() => {}); // who needs it next, tries again

const hasWebGL = () => {
  const context = document.createElement("canvas").getContext("webgl");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return Boolean(context);
};

class View {
  constructor(div) {
    this.div = div;
    this.words = [...div.children]; // they stand here until the picture does
    this.messages = [];
    this.settings = {}; // what the scene says beside meshcat's commands, by name
    this.turned = this.raised = 0; // degrees
    this.wanted = Infinity; // s: a movement is first shown at its end
    this.listeners = [];
    views.set(div, this);
    new IntersectionObserver((entries) => entries.at(-1).isIntersecting && this.wake(), {
      rootMargin: "200px",
    }).observe(div);
    (self.requestIdleCallback ?? setTimeout)(load); // paper shows what was never in sight
    new ResizeObserver(() => this.viewer && (this.viewer.set_3d_pane_size(), this.look())).observe(div);
  }

  /* Come to life, unless the browser cannot: then the words in the div stay, and say why. */
  async wake() {
    await load();
    if (views.get(this.div) !== this) return; // the page has done with it
    live.delete(this);
    if (!bones) return this.showWords("The files of the 3-D picture did not come: load the page again.");
    if (!this.viewer && !hasWebGL()) return this.showWords(NO_WEBGL);
    try {
      if (!this.viewer) this.start();
    } catch (error) {
      console.error(error); // it may also be a fault of ours
      return this.showWords(NO_WEBGL);
    }
    live.add(this);
    if (live.size > MOST_LIVE) [...live][0].stop();
  }

  showWords(why) {
    const note = Object.assign(document.createElement("p"), { className: "vmc-note", textContent: why });
    this.viewer = this.body = null;
    live.delete(this);
    this.div.classList.add("vmc-flat");
    this.div.replaceChildren(...this.words, note);
  }

  start() {
    this.div.classList.remove("vmc-flat");
    const canvas = document.createElement("div");
    canvas.className = "vmc-canvas";
    this.div.replaceChildren(canvas);
    const viewer = new self.MeshCat.Viewer(canvas, false);
    viewer.gui.domElement.remove();
    viewer.set_3d_pane_size = function () {
      const { clientWidth: w, clientHeight: h } = canvas;
      if (w && h) Object.getPrototypeOf(viewer).set_3d_pane_size.call(viewer, w, h);
    };
    viewer.handle_command = function (command) {
      const { type, property = "" } = command;
      if (COMMANDS.has(type) && !/proto|constructor/.test(property)) Object.getPrototypeOf(viewer).handle_command.call(viewer, command);
    };
    for (const part of ["Grid", "Axes"]) viewer.set_property([part], "visible", false);
    viewer.hide_background();
    // the book's axes: x forward, y up, z right
    viewer.set_transform(["meshcat"], [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1]);
    viewer.camera.fov = 35;
    viewer.controls.enabled = false; // the view turns itself: by hand, and by its slider
    this.closeUp = new CloseUp(this, canvas);
    viewer.render = () => (this.closeUp.render(viewer), Object.getPrototypeOf(viewer).render.call(viewer));
    this.viewer = viewer;
    this.sent = new Map();
    this.body = null;
    viewer.set_3d_pane_size();
    const { posed } = this; // what others posed it to outlives the viewer
    this.show(this.messages);
    if (posed) this.pose(posed);
    this.onstart?.();
    addPointer(this, canvas);
    const { domElement } = viewer.renderer;
    domElement.addEventListener("webglcontextlost", () => this.viewer === viewer
      && this.showWords("The browser has taken the 3-D picture away: scroll on and back, or load the page again."));
    domElement.addEventListener("webglcontextrestored", () => this.viewer ?? this.wake());
    const draw = () => {
      if (this.viewer !== viewer) return;
      if (viewer.needs_render) viewer.render();
      requestAnimationFrame(draw);
    };
    draw();
  }

  /* Give the WebGL context back and leave a still of the last view. */
  stop() {
    const { viewer, closeUp } = this, near = closeUp.box.isConnected ? [closeUp.box] : [];
    const still = new Image();
    still.src = viewer.capture_image();
    still.alt = "";
    viewer.controls.dispose();
    viewer.renderer.dispose();
    viewer.renderer.forceContextLoss();
    viewer.set_3d_pane_size = () => {};
    this.viewer = this.body = null;
    live.delete(this);
    this.div.replaceChildren(still, ...near);
  }

  /* The page has done with it. */
  end() {
    if (this.viewer) this.stop();
    views.delete(this.div);
  }

  show(messages) {
    this.messages = messages;
    const next = new Map(messages.map((message) => message.split("|")));
    const pairs = [...next].filter(([key]) => !key.includes(" "));
    const { anatomy, ...settings } = Object.fromEntries(pairs.map(([key, data]) => [key, JSON.parse(data)]));
    this.settings = settings;
    if (anatomy) this.anatomy = new Anatomy(anatomy); // the page's Python does not tell it again
    if (this.viewer) (this.closeUp.putBack(), this.send(next));
    const { motion } = this.settings;
    if (motion) this.body?.draw(motion.q.map((q, i) => this.anatomy.wrist(q, motion.turn[i])));
    this.at(this.wanted);
    if (this.viewer) this.look();
  }

  send(next) {
    for (const key of [...this.sent.keys()])
      if (!next.has(key) && this.sent.has(key)) this.forget(key.split(" ")[1]);
    for (const [key, data] of next)
      if (key.includes(" ") && this.sent.get(key) !== data) {
        this.viewer.handle_command_bytearray(Uint8Array.from(atob(data), (c) => c.charCodeAt(0)));
        this.sent.set(key, data);
      }
    this.body ??= this.makeBody();
  }

  /* What moves in the viewer, if anything does; another arm than arm26 has its own. */
  makeBody() {
    return this.anatomy && new Body(this.viewer, this.anatomy, bones);
  }

  /* Take away everything at and under `path`; what is still wanted is then sent again. */
  forget(path) {
    this.viewer.handle_command({ type: "delete", path });
    for (const key of [...this.sent.keys()]) {
      const other = key.split(" ")[1];
      if (other === path || other.startsWith(`${path}/`)) this.sent.delete(key);
    }
  }

  /* How long the scene's movement takes, in s. */
  get duration() {
    return this.settings.motion ? (this.settings.motion.q.length - 1) * this.anatomy.every : 0;
  }

  /* Show the scene as it is at a time of its movement, between two moments a mixture; after its end, how
     far the hand has lifted what it grasps, from 0 to 1. */
  at(time, after = 0) {
    this.wanted = time;
    this.time = Math.min(time, this.duration);
    const { motion, miss } = this.settings;
    if (!motion) return;
    const pose = moment(motion, this.time / this.anatomy.every);
    if (this.viewer) this.closeUp.show(after);
    this.pose(pose, miss && this.viewer ? this.closeUp.lift(pose) : pose);
  }

  /* Put the arm into a pose { q, activation, turn, grasp }, drawn as it is `shown`; listeners are called. */
  pose(pose, shown = pose) {
    this.posed = pose;
    this.body?.pose(shown, this.time / this.anatomy?.every);
    this.listeners.forEach((listen) => listen(pose));
  }

  /* Walk around the scene and above it, in degrees from where its author stands. */
  turn(turned, raised = this.raised) {
    Object.assign(this, { turned, raised });
    if (this.viewer) this.look();
    this.listeners.forEach((listen) => listen(this.posed));
  }

  look() {
    const [eye, at] = this.settings.camera ?? [[0, 0, 1], [0, 0, 0]];
    const { camera, controls } = this.viewer;
    const [x, y, z] = minus(eye, at);
    const level = Math.hypot(x, z);
    const azimuth = Math.atan2(x, z) + (this.turned * Math.PI) / 180;
    const up = clip(Math.atan2(y, level) + (this.raised * Math.PI) / 180, 0.09, 1.4); // never from below the table
    const far = Math.hypot(level, y) * Math.max(1, WIDE / camera.aspect);
    const flat = far * Math.cos(up);
    controls.target.set(...at);
    camera.position.set(
      at[0] + flat * Math.sin(azimuth), at[1] + far * Math.sin(up), at[2] + flat * Math.cos(azimuth));
    this.viewer.set_dirty(); // one picture a frame, however often it moved
  }
}

/* On paper every scene is a still of its present state. */
let lived = [];
addEventListener("beforeprint", () => {
  if (!bones || !hasWebGL()) return; // all is fetched, and can be drawn
  lived = [...live];
  for (const view of views.values()) {
    if (!view.viewer) view.start();
    view.stop();
  }
});
addEventListener("afterprint", () => lived.forEach((view) => view.wake()));
export const viewOf = (div) => views.get(div) ?? new View(div);
