/* The muscle, Eq. 9–11 (vmc_lib/arm/muscle.py). */
import { clip } from "../vectors.js";

export class Muscle {
  constructor(constants) {
    Object.assign(this, constants);
  }

  activationRate(excitation, activation) {
    const { tauActivation, tauDeactivation } = this;
    const rise = excitation / tauActivation + (1 - excitation) / tauDeactivation;
    const gap = excitation - activation;
    return gap * (gap >= 0 ? rise : 1 / tauDeactivation);
  }

  forceLength(length) {
    const square = (length - 0.95) ** 2;
    return Math.exp(square - 40 * square ** 2);
  }

  forceVelocity(velocity) {
    const inverse = 1 / (1 - clip(velocity, ...this.velocityRange)) ** 2;
    return 1.6 - 1.6 * Math.exp(0.1 * inverse - 1.1 * inverse ** 2);
  }

  passiveForce(length) {
    return 1.3 * Math.atan(0.1 * (Math.max(length, 0.22) - 0.22) ** 10);
  }

  force(activation, length, velocity, maximum) {
    const active = this.forceLength(length) * this.forceVelocity(velocity) * activation;
    return maximum * (active + this.passiveForce(length));
  }

  /* Python sends its constants, and its answers to a few questions. Does its law differ? */
  get differs() {
    return this.answers.some(([u, a, length, velocity, rate, pull]) => {
      const own = [this.activationRate(u, a) / rate, this.force(a, length, velocity, 1) / pull];
      return own.some((ratio) => !(Math.abs(ratio - 1) < 1e-9));
    });
  }
}
