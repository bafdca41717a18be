/* The arm of six muscles, Eq. 12 (vmc_lib/arm/simulate.py, the engine "mujoco"). What vmc_lib adds to
   MuJoCo in Python is said once more in muscle.js, here, templates.js, planning.js and calibration.js,
   by the same names; a test holds every number to Python's. */
const vmcArm26 = (() => {
  "use strict";

  const { clip, minus, plus, times } = vmcVectors;
  const { Arm } = vmcArm;
  const { Muscle } = vmcMuscle;

  class Arm26 extends Arm {
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
      return this.hand(this.inverseKinematics(target));
    }

    /* The posture that puts the wrist at a place (x, y) of the plane: Newton's method. */
    inverseKinematics(target) {
      const q = [...this.given.start];
      for (let i = 0; i < 20; i++) {
        const nudged = [[0, 0], [1e-6, 0], [0, 1e-6]];
        const [here, first, second] = nudged.map((by) => this.hand(plus(q, by)));
        const [a, b] = [minus(first, here), minus(second, here)].map((v) => times(1e6, v));
        const miss = minus(target, here);
        const determinant = a[0] * b[1] - b[0] * a[1];
        q[0] += clip((miss[0] * b[1] - miss[1] * b[0]) / determinant, -0.2, 0.2);
        q[1] += clip((miss[1] * a[0] - miss[0] * a[1]) / determinant, -0.2, 0.2);
      }
      return q;
    }
  }

  return { Arm26 };
})();
