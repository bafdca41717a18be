/* An arm whose model MuJoCo reads from the same file as in Python; its constants come from there, in
   `given`. Here muscles obey MuJoCo's own law (reproduce/whole_arm/plant.py); arm26.js has the book's.
   Positions are metres, angles radians; none of these touches the page. */
export class Arm {
  constructor(mujoco, given) {
    Object.assign(this, { mujoco, given });
    const number = (kind, name) => mujoco.mj_name2id(this.model, mujoco.mjtObj[kind].value, name);
    this.model = mujoco.MjModel.from_xml_string(given.xml);
    this.data = new mujoco.MjData(this.model); // steps
    this.seen = new mujoco.MjData(this.model); // is looked at, in any posture
    this.bodies = given.joints.map((name) => number("mjOBJ_BODY", name)); // begin at these joints
    this.bones = Object.keys(given.bones ?? {}).map((name) => number("mjOBJ_BODY", name));
    this.tip = number("mjOBJ_SITE", given.tip);
    this.reset();
  }

  /* MuJoCo's memory is given back by hand. */
  free() {
    for (const part of [this.data, this.seen, this.model]) part.delete();
  }

  /* At rest in a posture, the muscles' activation as given: by default as every reach begins. */
  reset(posture = this.given.start, activation = this.given.rest) {
    this.mujoco.mj_resetData(this.model, this.data);
    this.state.qpos.set(posture);
    this.activation.set(activation);
  }

  /* Views of MuJoCo's memory: slow to make, void once another arm has made that memory grow. */
  get state() {
    if (!this.views?.qpos.length) {
      const { qpos, qvel, act, ctrl, ten_length, ten_J, qfrc_applied } = this.data;
      this.views = { qpos, qvel, act, ctrl, ten_length, ten_J, qfrc_applied };
    }
    return this.views;
  }

  get activation() {
    return this.state.act;
  }

  /* So long as a command lasts, `given.step` seconds, the muscles hear `excitation`. */
  step(excitation) {
    const { mujoco, model, data } = this;
    this.state.ctrl.set(excitation);
    for (let i = 0; i < this.given.steps; i++) mujoco.mj_step(model, data);
  }

  /* A movement from rest, as excitations (a list) ask: its moments, before and after each. */
  move(excitations) {
    this.reset();
    const moment = () => ({ q: [...this.state.qpos], activation: [...this.activation] });
    const motion = [moment()];
    for (const excitation of excitations) {
      this.step(excitation);
      motion.push(moment());
    }
    return motion;
  }

  /* A reach, and the hold after it: the last command is kept on (vmc_lib/motor/templates.py). */
  reach(excitations) {
    return this.move([...excitations, ...Array(this.given.held).fill(excitations.at(-1))]);
  }

  /* Where the hand is during the hold of a reach; its mean is the end point. */
  hold(reach) {
    const moments = reach.slice(-1 - this.given.held).filter((_, t) => t % this.given.every === 0);
    return moments.map(({ q }) => this.hand(q));
  }

  /* From the shoulder to the hand: where the joints are in posture q, and what reaches. */
  joints(q) {
    const { model, seen } = this;
    seen.qpos.set(q);
    this.mujoco.mj_kinematics(model, seen);
    const { xpos, site_xpos } = seen;
    return [...this.bodies.map((body) => point(xpos, body)), point(site_xpos, this.tip)];
  }

  hand(q) {
    return this.joints(q).at(-1);
  }

  /* What is drawn of a posture: its joints, each bone's frame, each muscle's way. */
  look(q) {
    const { mujoco, model, seen } = this;
    const joints = this.joints(q);
    mujoco.mj_comPos(model, seen); // which tendons need
    mujoco.mj_tendon(model, seen);
    const { xpos, xmat, ten_wrapadr, ten_wrapnum, wrap_xpos } = seen;
    const frames = this.bones.map((body) => [...xmat.slice(9 * body, 9 * body + 9), ...point(xpos, body)]);
    const way = (first, k) =>
      Array.from({ length: ten_wrapnum[k] }, (_, i) => point(wrap_xpos, first + i));
    return { joints, frames, ways: Array.from(ten_wrapadr, way) };
  }

  /* Where in space a target lies. */
  place(target) {
    return target;
  }
}

const point = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];
