/* Inverse kinematics: from where the hand should be to the joints' angles and the trunk's turn
   (vmc_lib/arm/kinematics.py). `arm` is what Python gives of it, KINEMATICS in page/arm/live.py. */
import { clip, degrees, dot, minus, plus, signed, times, turnAboutY } from "../vectors.js";

/* The wrist in posture q, in the shoulder frame before the trunk turns (vmc_lib/arm/dynamics.py). */
export const hand = (arm, [shoulder, elbow]) => {
  const [c1, s1, c2, s2] = [Math.cos(shoulder), Math.sin(shoulder), Math.cos(elbow), Math.sin(elbow)];
  const basis = [1, c1, s1, c2, s2, c1 * c2 - s1 * s2, s1 * c2 + c1 * s2, c2 * c1, c2 * s1, c2 * c2, c2 * s2];
  return arm.hand.map((row) => dot(row, basis));
};

const bearing = ([x, y]) => Math.atan2(x, -y);
const placeText = (place) => place.map((x) => signed(x, 3)).join(", ");

/* The posture with `measure(q)` as wanted: Newton's method from near a place `guess` of the plane. */
const findPosture = (arm, measure, wanted, guess, target) => {
  const [low, high] = arm.bent[1], far = Math.hypot(...guess);
  const elbows = Array.from({ length: 100 }, (_, i) => high + (i / 99) * (low - high)); // ever straighter
  const reach = elbows.map((elbow) => Math.hypot(...hand(arm, [0, elbow]).slice(0, 2)));
  const next = clip(reach.findIndex((distance) => distance >= far), 1, 99), i = far > reach[99] ? 99 : next;
  const share = clip((far - reach[i - 1]) / (reach[i] - reach[i - 1]), 0, 1);
  const elbow = elbows[i - 1] + share * (elbows[i] - elbows[i - 1]);
  let q = [bearing(guess) - bearing(hand(arm, [0, elbow])), elbow];
  for (let round = 0; round < 12; round++) {
    const here = measure(q), miss = minus(wanted, here);
    const [a, b] = [[1e-6, 0], [0, 1e-6]].map((by) => times(1e6, minus(measure(plus(q, by)), here)));
    const area = a[0] * b[1] - b[0] * a[1];
    const step = [miss[0] * b[1] - miss[1] * b[0], miss[1] * a[0] - miss[0] * a[1]].map((x) => clip(x / area, -0.2, 0.2));
    q = plus(q, step).map((angle, joint) => clip(angle, ...arm.bent[joint]));
  }
  if (!minus(measure(q), wanted).every((off) => Math.abs(off) <= 1e-9))
    throw new RangeError(`position ${placeText(target)} m lies beyond the arm's reach of ` +
      `${reach[0].toFixed(2)} to ${reach[99].toFixed(2)} m; move the target`);
  return q;
};

/* The posture that puts the wrist at a place (x, y) of the arm's plane; RangeError beyond its reach. */
export const inverseKinematics = (arm, place) => findPosture(arm, (q) => hand(arm, q).slice(0, 2), place, place, place);

/* The trunk's `turn` (rad, positive to the left) that brings a target (3,) of the room into the arm's plane,
   and the `place` (x, y) where it then lies there; RangeError where no turn does. */
export const turnTowards = (arm, target) => {
  const { axis, range } = arm.trunk, [x, z] = minus([target[0], target[2]], axis);
  const aside = (q) => { const [u, , w] = hand(arm, q); return minus([u, w], axis); };
  const measure = (q) => [Math.hypot(...aside(q)), hand(arm, q)[1]];
  const ahead = Math.sqrt(Math.max(x * x + z * z - (0.06 - axis[1]) ** 2, 0)); // about
  const q = findPosture(arm, measure, [Math.hypot(x, z), target[1]], [axis[0] + ahead, target[1]], target);
  const [u, w] = aside(q), turn = Math.atan2(w, u) - Math.atan2(z, x);
  if (turn < range[0] || turn > range[1])
    throw new RangeError(`${placeText(target)} m needs a turn of ${degrees(turn, 0)}; move the target`);
  return { turn, place: hand(arm, q).slice(0, 2) };
};

/* A point of the turned shoulder frame, in that of the trunk straight ahead. */
export const toWorld = ({ trunk: { axis } }, point, turn) => turnAboutY(point, turn, axis);
