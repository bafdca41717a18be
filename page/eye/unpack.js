/* All that the eye has learnt, as page/eye/brain.py packs it. */
import { fetchVendored, once, unzip } from "../vendored.js";

const KINDS = { float64: Float64Array, float32: Float32Array, float16: Uint16Array, int16: Int16Array, int8: Int8Array, uint8: Uint8Array };
const POWERS = Array.from({ length: 32 }, (_, i) => 2 ** (Math.max(i, 1) - 25));
const ROW = 3 * 33; // numbers along one axis of the grid of colours

/* What the 16 bits of a half-precision number stand for. */
const decodeHalf = (bits) => {
  const exponent = (bits >> 10) & 31, size = (bits & 1023) + (exponent && 1024);
  return (bits & 0x8000 ? -size : size) * POWERS[exponent];
};
const decodeHalves = (bits) => {
  const numbers = new Float64Array(bits.length);
  for (let i = 0; i < bits.length; i++) numbers[i] = decodeHalf(bits[i]);
  return numbers;
};

/* The grid of Lab colours, whose rows along blue came as differences: of each the first colour is whole. */
const addAlongBlue = (lab) => {
  for (let i = 0; i < lab.length; i++) if (i % ROW >= 3) lab[i] += lab[i - 3];
};

/* A promise of the brain: objects and lists of numbers and typed arrays. Its script comes from the book's own
   files, when it is first asked for. */
export const unpack = once(async () => {
  if (!self.vmcBrain) await fetchVendored("brain.js");
  const { tree, arrays } = self.vmcBrain, buffer = await unzip(arrays).arrayBuffer();
  const revive = (_, it) => {
    if (!it?.kind) return it;
    const array = new KINDS[it.kind](buffer, it.at, it.length);
    return it.kind === "float16" ? decodeHalves(array) : array;
  };
  const brain = JSON.parse(tree, revive);
  delete self.vmcBrain; // megabytes of text
  addAlongBlue(brain.lab);
  return brain;
});
