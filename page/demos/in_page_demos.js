/* What the book's demos work out in the page, for any position of the reader's hand (vmc_lib.show.explore,
   `in_page`). Each takes what Python gave, the control's values, the pictures' axes, and the place of these
   values among all; it returns what is seen in words, and the marks on each picture. */
const vmcInPage = (() => {
  "use strict";

  const { backProject, iou, nms, project } = vmcEye;
  const { clip, dot, minus, plus, solve, sum, times } = vmcVectors;

  /* A box on a photo. */
  const frame = ([x0, y0, x1, y1], stroke, edge) => {
    const at = `x="${x0}" y="${y0}" width="${x1 - x0}" height="${y1 - y0}"`;
    return `<rect ${at} ${edge}/><rect ${at} stroke="${stroke}"/>`;
  };

  /* Words in a photo's upper left corner (book/figures/where.py, in_corner). */
  const inCorner = (words, colour, edge) => frame([8, 0, 8, 0], colour, edge) +
    `<text x="8" y="21" fill="${colour}" ${edge} paint-order="stroke">${words}</text>`;

  /* Two boxes on a photo: the object's, and one whose middle and whose size the reader drags. */
  const overlap = ({ object, edge, paint }, [x, y, wide, high]) => {
    const box = [x - wide / 2, y - high / 2, x + wide / 2, y + high / 2];
    const shared = iou(box, object).toFixed(2);
    const colour = shared >= 0.8 ? paint.green : shared > 0.5 ? paint.orange : paint.red;
    return [
      `A box around ${x.toFixed(0)}, ${y.toFixed(0)}, ${wide.toFixed(0)} × ${high.toFixed(0)}: IoU ${shared}.`,
      frame(object, paint.grey, edge) + frame(box, colour, edge) + inCorner(`IoU ${shared}`, colour, edge),
    ];
  };
  overlap.views = () => [
    { toView: (middle) => middle, fromView: (seen) => seen },
    {
      pad: 1,
      toView: (size, [middle]) => plus(middle, times(0.5, size)),
      fromView: (corner, [middle]) => times(2, minus(corner, middle)),
    },
  ];

  /* Boxes, the best first, after so many steps of non-maximum suppression (book/figures/suppression.py). */
  const suppression = ({ boxes, edge, paint }, [step, overlap]) => {
    const all = { grey: boxes.map((_, i) => i), gone: [], red: [], green: [] }; // by their colours
    for (let k = 0; k < step; k++) {
      const [best, ...rest] = all.grey;
      all.gone.push(...all.red.splice(0));
      if (best === undefined) break;
      all.green.push(best);
      all.red = rest.filter((i) => iou(boxes[best], boxes[i]) > overlap);
      all.grey = rest.filter((i) => !all.red.includes(i));
    }
    const words = `${all.green.length} kept, ${all.gone.length + all.red.length} suppressed, ${all.grey.length} wait`;
    const frames = ["grey", "red", "green"].map((colour) => all[colour].map((i) => frame(boxes[i], paint[colour], edge)).join(""));
    return [`A photo with labels: ${words}.`, frames.join("") + inCorner(words, paint.ink, edge)];
  };

  /* What non-maximum suppression keeps of the boxes [...box, score, the objects it holds] of some photos,
     the best first. */
  const suppress = (shots, allowed) =>
    shots.flatMap((boxes, shot) =>
      nms(boxes, boxes.map((box) => box[4]), allowed).map((i) =>
        ({ box: boxes[i], shot, score: boxes[i][4], holds: boxes[i].slice(5) })),
    ).sort((a, b) => b.score - a.score);

  /* A photo with the boxes above a threshold, and precision against recall (book/figures/trade.py). */
  const trade = ({ levels, shown, edge, paint }, [name, threshold, allowed], [, plot]) => {
    const level = levels[name], found = new Set();
    if (level.allowed !== allowed) Object.assign(level, { allowed, kept: suppress(level.shots, allowed) });
    let right = 0;
    const curve = level.kept.map(({ shot, holds }, n) => {
      right += holds.length > 0;
      for (const thing of holds) found.add(`${shot} ${thing}`);
      return [found.size / level.objects, right / (n + 1)];
    });
    const above = level.kept.filter(({ score }) => score > threshold);
    const [recall, precision] = curve[above.length - 1] ?? [0, 0];
    const rates = `precision ${(precision + 1e-9).toFixed(2)}, recall ${(recall + 1e-9).toFixed(2)}`; // halves up
    const here = above.filter(({ shot }) => shot === shown)
      .map(({ box, holds }) => frame(box.slice(0, 4), paint[holds.length ? "green" : "red"], edge));
    return [
      `${above.length} boxes are kept: ${rates}.`,
      `<image width="100%" height="100%" href="${level.image}"/>${here.join("")}`,
      plot.mark("line", "blue", curve, 1.8, 0, "precision") + plot.mark("dot", "red", [recall, precision], 4) +
        plot.mark("words", "ink", plot.head, rates, 6),
    ];
  };

  /* A reach planned from four templates, where it ends, and one muscle's excitation as their sum. */
  const plan = ({ points, commands, ends, every }, target, [plane, time], place) => {
    const { chosen, weights } = vmcPlanning.plan(target, { points });
    const end = ends[place];
    const miss = (1000 * Math.hypot(end[0] - target[0], end[1] - target[1])).toFixed(1);
    const parts = chosen.map((row, i) => times(weights[i], commands[row]));
    const mixed = parts[0].map((_, t) => sum(parts.map((part) => part[t])));
    const curve = (colour, values, width, name) =>
      time.mark("line", colour, values.map((value, t) => [t * every, value]), width, 0, name);
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
      parts.map((part, i) => curve("blue", part, 1, `template ${i + 1}`)).join("") + curve("red", mixed, 1.8, "their sum"),
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
        named("red", total, "the sum", -30) + plane.mark("words", "ink", [-1.3, 1.15], off, 0),
    ];
  };

  /* A block of probabilistic max-pooling: at most one of its units is on (book/figures/crbm.py). */
  const block = (_, drives, [plot]) => {
    const total = 1 + sum(drives.map(Math.exp));
    const chances = [...drives.map((drive) => Math.exp(drive) / total), 1 / total];
    const words = `pooled unit on: ${(1 - 1 / total).toFixed(3)}`;
    return [
      `Chances: ${chances.map((chance) => chance.toFixed(2)).join(", ")}; ${words}.`,
      chances.map((chance, i) =>
        plot.mark("area", i < 4 ? "blue" : "grey", [[i - 0.4, 0], [i - 0.4, chance], [i + 0.4, chance], [i + 0.4, 0]]) +
        plot.mark("words", "ink", [i, chance], chance.toFixed(2), 3)).join("") +
        plot.mark("words", "ink", plot.head, words, 6),
    ];
  };

  /* Crops by their probability, in two rows, and the line right of which they are called shuttlecocks
     (book/figures/names.py). */
  const line = (given, [level, method, threshold], [plot]) => {
    const { chances, spread, truth } = given[level], mine = chances[method];
    const called = mine.map((chance) => chance > threshold);
    const right = called.filter((yes, i) => yes && truth[i]).length;
    const share = (all) => (right / all.filter(Boolean).length + 1e-9).toFixed(3).replace("NaN", "–");
    const words = `precision ${share(called)}, recall ${share(truth)}`;
    return [
      `Threshold ${threshold}: ${words}.`,
      mine.map((chance, i) => plot.mark("dot", truth[i] ? "blue" : "orange", [chance, spread[i]], 2)).join("") +
        plot.mark("line", "ink", [[threshold, -0.45], [threshold, 1.45]], 1.8) + plot.mark("words", "ink", plot.head, words, 6),
    ];
  };

  /* Granule cells along a line of targets, the Purkinje cell that sums them after some lessons, and how all
     answer at one place (book/figures/granule.py). */
  const bells = ({ lessons, uniform, ridge, line: [x, needed], edges, shown }, [width, count, place], [plot]) => {
    const some = lessons.slice(0, count), ends = some.map(([at]) => at);
    const [low, high] = [Math.min(...ends) - width, Math.max(...ends) + width];
    const centres = uniform.map((u) => low + (high - low) * u);
    const bell = (at, centre) => Math.exp(-((at - centre) ** 2) / (2 * width ** 2));
    const excite = (at) => centres.map((centre) => bell(at, centre));
    const active = ends.map(excite);
    const gram = active.map((row, i) => active.map((other, j) => dot(row, other) + (i === j) * ridge));
    const shares = solve(gram, some.map(([, aside]) => aside));
    const purkinje = active.map((row, k) => times(shares[k], row)).reduce(plus);
    const said = x.map((at) => dot(excite(at), purkinje));
    const off = minus(said, needed).map(Math.abs), now = x.indexOf(place);
    const inside = (y) => clip(y, ...edges);
    const curve = (colour, ys, size, name) => plot.mark("line", colour, x.map((at, i) => [at, ys[i]]), size, 0, name);
    const words = `off by ${(sum(off) / x.length).toFixed(2)} mm on average, here by ${off[now].toFixed(2)}`;
    const [floor] = edges;
    return [
      `After ${count} lessons, cells ${width} m wide: ${words}.`,
      centres.filter((_, j) => j % shown === 0)
        .map((centre) => curve("line", x.map((at) => floor - floor * bell(at, centre)), 1)).join("") +
        centres.map((at) => plot.mark("dot", "orange", [at, floor / 2], (3 * bell(place, at)).toFixed(2))).join("") +
        curve("grey", needed, 1.8, "what is needed") + curve("red", said.map(inside), 1.8, "the cells' sum") +
        some.map((lesson) => plot.mark("dot", "blue", lesson, 3)).join("") +
        plot.mark("line", "purple", [[place, inside(said[now])], [place, needed[now]]], 3) +
        plot.mark("words", "ink", plot.head, words, 6),
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
    const away = 100 * Math.hypot(place[0] - axis[0], place[2] - axis[1]);
    const words = `${away.toFixed(0)} cm from the axis: ${trunk}`.replaceAll("-", "−");
    const ring = `<circle cx="${pixel[0].toFixed(1)}" cy="${pixel[1].toFixed(1)}" r="6"`;
    const line = (colour, ...points) => above.mark("line", colour, points, 1.8);
    return [
      `${Math.abs(far).toFixed(0)} cm ${way}, ${Math.abs(right).toFixed(0)} cm ${side}; ${words}.`,
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
      picture: 1,
      toView: (pixel) => backProject(camera, pixel, height).filter((_, k) => k !== 1).reverse(),
      fromView: ([right, ahead]) => project(camera, [ahead, height, right]),
    },
  ];

  for (const work of [aim, block, line, overlap, suppression, trade, votes]) work.between = true; // at any values
  return { aim, bells, block, line, overlap, plan, suppression, trade, votes };
})();
