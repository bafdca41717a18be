/* A choice among detections by what both pathways say, and by physical size (vmc_lib/box_selection.py). */
Object.assign(vmcEye, (() => {
  "use strict";

  const AS_IT_IS = [[1, 1]];

  /* The detections whose boxes, seen by a camera, are of a shuttlecock's physical size. */
  const filterBySize = ({ boxes, scores }, camera, { sizes: [smallest, largest], table }) => {
    const size = boxes.map((box) => vmcEye.physicalSize(camera, box, table));
    const right = (_, i) => size[i] > smallest && size[i] < largest;
    return { boxes: boxes.filter(right), scores: scores.filter(right) };
  };

  /* The stream's answers to some boxes, one a piece, and the boxes refined by them. */
  const lookAt = function* (stream, photo, boxes, flips) {
    const answers = [];
    for (const box of boxes) {
      answers.push(vmcEye.look(stream, photo, box, flips));
      yield;
    }
    const refined = boxes.map((box, i) => vmcEye.decodeDeltas(box, answers[i].deltas));
    return { refined, logOdds: answers.map(({ logOdds }) => logOdds) };
  };

  const logistic = (logOdds) => 1 / (1 + Math.exp(-logOdds));

  /* The refined boxes, the most probable first, and the probability that each holds a shuttlecock; `ratio` multiplies
     its odds. It reports what the first look says of the boxes. */
  const select = function* ({ selector, stream }, photo, { boxes, scores }, ratio, report) {
    const { weights: [byScore, byName], bias: [bias], firstPass, secondPass } = selector;
    const first = yield* lookAt(stream, photo, boxes.slice(0, firstPass), AS_IT_IS);
    report({ boxes: first.refined, probability: first.logOdds.map(logistic) });
    const best = vmcEye.falling(first.logOdds).slice(0, secondPass);
    const { refined, logOdds } = yield* lookAt(stream, photo, best.map((i) => first.refined[i]), stream.flips);
    const kept = vmcEye.nms(refined, logOdds);
    const evidence = kept.map((i) => byScore * scores[best[i]] + byName * logOdds[i] + bias);
    const order = vmcEye.falling(evidence);
    return {
      boxes: order.map((i) => refined[kept[i]]),
      probability: order.map((i) => logistic(evidence[i] + Math.log(ratio))),
    };
  };

  return { filterBySize, select };
})());
