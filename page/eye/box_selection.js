/* A choice among detections by what both pathways say, and by physical size (vmc_lib/box_selection.py). */
Object.assign(vmcEye, (() => {
  "use strict";

  /* Whether a box, seen by a camera, is of a shuttlecock's physical size. */
  const hasRightSize = (box, camera, { sizes: [smallest, largest], table }) => {
    const size = vmcEye.physicalSize(camera, box, table);
    return size > smallest && size < largest;
  };
  const filterBySize = ({ boxes, scores }, camera, selector) => {
    const right = boxes.map((box) => hasRightSize(box, camera, selector)), isRight = (_, i) => right[i];
    return { boxes: boxes.filter(isRight), scores: scores.filter(isRight) };
  };

  /* What the stream says of a box, as it is or flipped: the log-odds of a shuttlecock, and the `box` refined. */
  const refine = (stream, photo, box, flips = [[1, 1]]) => {
    const { logOdds, deltas } = vmcEye.look(stream, photo, box, flips);
    return { logOdds, box: vmcEye.decodeDeltas(box, deltas) };
  };
  const refineEach = function* (stream, photo, boxes, flips) {
    const answers = yield* vmcEye.each(boxes, (box) => refine(stream, photo, box, flips));
    return { refined: answers.map(({ box }) => box), logOdds: answers.map(({ logOdds }) => logOdds) };
  };

  const logistic = (logOdds) => 1 / (1 + Math.exp(-logOdds));

  /* The refined boxes, the most probable first, and the probability that each holds a shuttlecock; `ratio` multiplies
     its odds. It reports what the first look says of the boxes. */
  const select = function* ({ selector, stream }, photo, { boxes, scores }, ratio, report) {
    const { weights: [byScore, byName], bias: [bias], firstPass, secondPass } = selector;
    const first = yield* refineEach(stream, photo, boxes.slice(0, firstPass));
    report({ boxes: first.refined, probability: first.logOdds.map(logistic) });
    const best = vmcEye.falling(first.logOdds).slice(0, secondPass);
    const { refined, logOdds } = yield* refineEach(stream, photo, best.map((i) => first.refined[i]), stream.flips);
    const kept = vmcEye.nms(refined, logOdds);
    const evidence = kept.map((i) => byScore * scores[best[i]] + byName * logOdds[i] + bias);
    const order = vmcEye.falling(evidence);
    return {
      boxes: order.map((i) => refined[kept[i]]),
      probability: order.map((i) => logistic(evidence[i] + Math.log(ratio))),
    };
  };

  return { filterBySize, hasRightSize, refine, select };
})());
