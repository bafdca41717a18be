import { toWorld, turnTowards } from "../arm/kinematics.js";
import { backProject, project } from "../eye/camera.js";
import { degrees, times } from "../vectors.js";

/* The trunk's turn that brings the hand's plane to a place; nothing where the hand cannot be. */
const trunkTurn = (arm, place) => {
  try {
    return turnTowards(arm, place).turn;
  } catch {
    return null;
  }
};

/* A target in a photo, and from above the place that it means (book/figures/aiming.py). */
export const aim = (given, pixel, [photo, above]) => {
  const { arm, camera, marks: { height, ahead, edge, paint } } = given, { axis } = arm.trunk;
  const place = backProject(camera, pixel, height);
  const turn = trunkTurn(arm, place);
  const reached = turn !== null;
  const flat = ([x, , z]) => [z, x];
  const turnPoint = (point) => flat(toWorld(arm, point, turn));
  const [far, , right] = times(100, place);
  const trunk = reached ? `the trunk turns ${degrees(turn, 0)}` : "out of reach";
  const [way, side] = [far > 0 ? "ahead" : "behind", right > 0 ? "right" : "left"];
  const away = 100 * Math.hypot(place[0] - axis[0], place[2] - axis[1]);
  const words = `${away.toFixed(0)} cm from the axis: ${trunk}`;
  const ring = `<circle cx="${pixel[0].toFixed(1)}" cy="${pixel[1].toFixed(1)}" r="6"`;
  const line = (colour, ...points) => above.mark("line", colour, points, 1.8);
  return [
    `${Math.abs(far).toFixed(0)} cm ${way}, ${Math.abs(right).toFixed(0)} cm ${side}; ${words}.`,
    `${ring} ${edge}/>${ring} stroke="${paint[reached ? "green" : "red"]}"/>`,
    line("blue", flat(camera.position), flat(place)) +
      (reached ? line("purple", [...axis].reverse(), turnPoint([0, 0, 0])) + line("grey", ...ahead.map(turnPoint)) : "") +
      above.mark("dot", reached ? "green" : "red", flat(place), 4.5) + above.mark("words", "ink", above.head, words, 6),
  ];
};

/* Each picture takes a handle: how it shows what the pad stands at, and what a place on it means. */
aim.views = ({ camera, marks: { height } }) => [
  { toView: (pixel) => pixel, fromView: (pixel) => pixel },
  {
    picture: 1,
    toView: (pixel) => backProject(camera, pixel, height).filter((_, k) => k !== 1).reverse(),
    fromView: ([right, ahead]) => project(camera, [ahead, height, right]),
  },
];
aim.between = true; // at any values
