/* The arm of six muscles, Eq. 12 (vmc_lib/arm/simulate.py, the engine "mujoco"). What vmc_lib adds to
   MuJoCo in Python is said once more in muscle.js, here, templates.js, planning.js and calibration.js,
   by the same names; a test holds every number to Python's. */
import { clip } from "../vectors.js";
import { Arm } from "./arm.js";
import { hand, inverseKinematics } from "./kinematics.js";
import { Muscle } from "./muscle.js";

export class Arm26 extends Arm {
  muscle = new Muscle(this.given.muscle);

  get activation() {
    return (this.active ??= new Float64Array(this.given.rest.length));
  }

  /* One step of 1 ms: the muscles pull as they are active now, and hear `excitation` (6). */
  step(excitation) {
    const { mujoco, model, data, muscle, activation, given } = this;
    const { qpos, qvel, ten_length, ten_J, qfrc_applied } = this.state;
    mujoco.mj_step1(model, data);
    const torque = [0, 1].map((joint) => this.stopTorque(qpos[joint], qvel[joint], joint));
    for (let k = 0; k < activation.length; k++) {
      const [shoulder, elbow] = [ten_J[2 * k], ten_J[2 * k + 1]]; // minus the moment arms
      const stretching = shoulder * qvel[0] + elbow * qvel[1];
      const length = (ten_length[k] - given.slack[k]) / given.L0[k];
      const velocity = stretching / (muscle.maxVelocity * given.L0[k]);
      const pull = muscle.force(activation[k], length, velocity, given.F0[k]);
      torque[0] -= shoulder * pull;
      torque[1] -= elbow * pull;
      activation[k] += given.step * muscle.activationRate(excitation[k], activation[k]);
    }
    qfrc_applied.set(torque);
    mujoco.mj_step2(model, data);
  }

  /* The torque of a joint's stop: a damped spring beyond its limits, nothing within. */
  stopTorque(angle, velocity, joint) {
    const { limits, stop } = this.given;
    const beyond = angle - clip(angle, ...limits[joint]);
    return -stop.stiffness * (beyond + stop.damping * Math.abs(beyond) * velocity);
  }

  /* Its viewer works out bones and muscles from the posture itself. */
  look(q) {
    return { joints: this.joints(q) };
  }

  /* Where in space a target (x, y) of its plane lies. */
  place(target) {
    const { kinematics } = this.given;
    return hand(kinematics, inverseKinematics(kinematics, target));
  }
}
