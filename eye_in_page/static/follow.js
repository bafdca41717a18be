/* A shuttlecock followed from one frame of a film to the next: the ventral stream's corrections draw a box back onto
   what has moved in it, or beside it. */
vmcEye.follow = (() => {
  "use strict";

  const LOOKS = 3, AS_IT_IS = [[1, 1]], ASIDE = [-0.6, 0, 0.6]; // in sides of the box: where else it is looked for

  const look = ({ stream }, photo, box) => {
    const { logOdds, deltas } = vmcEye.look(stream, photo, box, AS_IT_IS);
    return { logOdds, box: vmcEye.decodeDeltas(box, deltas) };
  };

  /* A box corrected again and again, and the log-odds of the last look. */
  const refine = function* (brain, photo, box) {
    let seen = { box };
    for (let n = 0; n < LOOKS; n++) {
      seen = look(brain, photo, seen.box);
      yield;
    }
    return seen;
  };

  /* The box of what was in a box one frame ago; null where nothing of a shuttlecock's looks and size is near. */
  return function* (brain, photo, box, camera) {
    const { sizes: [smallest, largest], table } = brain.selector;
    const right = (seen) => {
      const size = vmcEye.physicalSize(camera, seen.box, table);
      return seen.logOdds > 0 && size > smallest && size < largest;
    };
    let best = yield* refine(brain, photo, box);
    if (!right(best)) {
      const around = [];
      for (const x of ASIDE)
        for (const y of ASIDE) {
          around.push(look(brain, photo, vmcEye.decodeDeltas(box, [x, y, 0, 0])));
          yield;
        }
      best = yield* refine(brain, photo, around.reduce((a, b) => (b.logOdds > a.logOdds ? b : a)).box);
    }
    return right(best) ? best.box : null;
  };
})();
