/* What the book's demos work out in the page, for any position of the reader's hand (vmc_lib.show.explore,
   `in_page`). Each takes what Python gave, the control's values, the pictures' axes, and the place of these
   values among all; it returns what is seen in words, and the marks on each picture. */
const vmcInPage = (() => {
  "use strict";

  const { backProject, iou, project } = vmcEye;
  const { dot, minus, plus, sum, times } = vmcVectors;

  /* Two boxes on a photo: the object's, and one as large whose corner the reader drags. */
  const overlap = ({ object, edge, paint }, [x, y]) => {
    const box = [x, y, x + object[2] - object[0], y + object[3] - object[1]];
    const shared = iou(box, object).toFixed(2);
    const colour = shared >= 0.8 ? paint.green : shared > 0.5 ? paint.orange : paint.red;
    const frame = ([x0, y0, x1, y1], stroke) => {
      const at = `x="${x0}" y="${y0}" width="${x1 - x0}" height="${y1 - y0}"`;
      return `<rect ${at} ${edge}/><rect ${at} stroke="${stroke}"/>`;
    };
    const label = `<text x="8" y="21" fill="${colour}" ${edge} paint-order="stroke">IoU ${shared}</text>`;
    const corner = frame([8, 0, 8, 0], colour); // what it labels: book/figures/where.py, in_corner
    return [
      `A box at ${x.toFixed(0)}, ${y.toFixed(0)}: IoU ${shared}.`,
      frame(object, paint.grey) + frame(box, colour) + corner + label,
    ];
  };

  /* A reach planned from four templates, where it ends, and one muscle's excitation as their sum. */
  const plan = ({ points, commands, ends, every }, target, [plane, time], place) => {
    const { chosen, weights } = vmcPlanning.plan(target, { points });
    const end = ends[place];
    const miss = (1000 * Math.hypot(end[0] - target[0], end[1] - target[1])).toFixed(1);
    const parts = chosen.map((row, i) => times(weights[i], commands[row]));
    const mixed = parts[0].map((_, t) => sum(parts.map((part) => part[t])));
    const curve = (colour, values, width) =>
      time.mark("line", colour, values.map((value, t) => [t * every, value]), width);
    const thread = (row, i) =>
      plane.mark("line", "blue", [target, points[row]], 10 * weights[i]) + plane.mark("dot", "blue", points[row], 3.5) +
      plane.mark("words", "ink", points[row], weights[i].toFixed(2), points[row][1] >= target[1] ? 7 : -14);
    const from = `${target.map((x) => x.toFixed(3).replace("-", "−")).join(", ")}`;
    return [
      `A target at ${from} m and the four templates that plan it; the hand ends ${miss} mm away. ` +
        "Beside it, one muscle's excitation as a weighted sum.",
      chosen.map(thread).join("") + plane.mark("line", "red", [target, end], 1) +
        plane.mark("ring", "green", target, 4) + plane.mark("dot", "red", end, 2) +
        plane.mark("words", "ink", plane.head, `the hand misses by ${miss} mm`, 6),
      parts.map((part) => curve("blue", part, 1)).join("") + curve("red", mixed, 1.8),
    ];
  };

  /* How neurons vote for a reach, each along the direction that it prefers, and their sum
     (book/figures/votes.py). */
  const votes = (_, [x, y, neurons, evenly], [plane]) => {
    const target = [x, y];
    const cast = Array.from({ length: neurons }, (_, i) => {
      const angle = 2 * Math.PI * (evenly ? i / neurons : (i / neurons) ** 2);
      const prefers = [Math.cos(angle), Math.sin(angle)];
      return times(dot(prefers, target), prefers);
    });
    const total = times(2 / neurons, cast.reduce(plus));
    const along = dot(total, target) / (Math.hypot(...total) * Math.hypot(...target));
    const off = `${((Math.acos(Math.min(1, along)) * 180) / Math.PI).toFixed(0)}° off`;
    const arrow = (colour, tip, width) => plane.mark("arrow", colour, [[0, 0], tip], width);
    const named = (colour, tip, words, above) =>
      arrow(colour, tip, 2) + plane.mark("words", colour, tip, words, above);
    const to = target.map((n) => n.toFixed(2).replace("-", "−")).join(", ");
    return [
      `Votes of ${neurons} neurons for a reach to ${to}; their sum is ${off}.`,
      cast.map((vote) => arrow("grey", vote, 1)).join("") + named("green", target, "the reach", 22) +
        named("red", total, "the sum", -30) + plane.mark("words", "ink", [0, 1.15], off, 0),
    ];
  };

  /* The trunk's turn that brings the hand's plane to a place; nothing where the hand cannot be. */
  const trunkTurn = (arm, place) => {
    try {
      return vmcKinematics.turnTowards(arm, place).turn;
    } catch {
      return null;
    }
  };

  /* A target in a photo, and from above the place that it means (book/figures/aiming.py). */
  const aim = (given, pixel, [photo, above]) => {
    const { arm, camera, marks: { height, ahead, edge, paint } } = given, { axis } = arm.trunk;
    const place = backProject(camera, pixel, height);
    const turn = trunkTurn(arm, place);
    const reached = turn !== null;
    const flat = ([x, , z]) => [z, x];
    const turned = (point) => flat(vmcKinematics.toWorld(arm, point, turn));
    const [far, , right] = times(100, place);
    const trunk = reached ? `the trunk turns ${((turn * 180) / Math.PI).toFixed(0)}°` : "out of reach";
    const [way, side] = [far > 0 ? "ahead" : "behind", right > 0 ? "right" : "left"];
    const words = `${Math.abs(far).toFixed(0)} cm ${way}, ${Math.abs(right).toFixed(0)} cm ${side}: ${trunk}`
      .replaceAll("-", "−");
    const ring = `<circle cx="${pixel[0].toFixed(1)}" cy="${pixel[1].toFixed(1)}" r="6"`;
    const line = (colour, ...points) => above.mark("line", colour, points, 1.8);
    return [
      `${words}.`,
      `${ring} ${edge}/>${ring} stroke="${paint[reached ? "green" : "red"]}"/>`,
      line("blue", flat(camera.position), flat(place)) +
        (reached ? line("purple", [...axis].reverse(), turned([0, 0, 0])) + line("grey", ...ahead.map(turned)) : "") +
        above.mark("dot", reached ? "green" : "red", flat(place), 4.5) + above.mark("words", "ink", above.head, words, 6),
    ];
  };
  /* Each picture takes a handle: how it shows what the pad stands at, and what a place on it means. */
  aim.views = ({ camera, marks: { height } }) => [
    { toView: (pixel) => pixel, fromView: (pixel) => pixel },
    {
      toView: (pixel) => backProject(camera, pixel, height).filter((_, k) => k !== 1).reverse(),
      fromView: ([right, ahead]) => project(camera, [ahead, height, right]),
    },
  ];

  return { aim, overlap, plan, votes };
})();
