import { Arm } from "./arm.js";
import { Arm26 } from "./arm26.js";
import { engine } from "./engine.js";

/* The arm that `given` describes: the book's own where it has the book's muscle law. */
export const load = async (given) => {
  const Kind = given.muscle ? Arm26 : Arm;
  return new Kind(await engine(), given);
};
