/* Long work is a generator that yields after each piece, so that the page may draw between two of them. */
const LONGEST = 30; // ms of work after which the page may draw

/* The result of all pieces at once. */
export const finish = (work) => {
  for (;;) {
    const { done, value } = work.next();
    if (done) return value;
  }
};

/* A promise of the result, with pauses in which the page draws and its reader is heard. */
export const inPieces = async (work) => {
  for (let begun = performance.now(); ; ) {
    const { done, value } = work.next();
    if (done) return value;
    if (performance.now() - begun < LONGEST) continue;
    await new Promise((resolve) => setTimeout(resolve));
    begun = performance.now();
  }
};

/* The results of a function of each of some things, `every` so many a piece. */
export const each = function* (things, look, every = 1) {
  const results = [];
  for (const thing of things) if (results.push(look(thing)) % every === 0) yield;
  return results;
};
