/* All that the eye has learnt, as page/eye/brain.py packs it. */
import { fetchVendored, unzip } from "../vendored.js";

const KINDS = { float64: Float64Array, float32: Float32Array, float16: Uint16Array, int16: Int16Array, int8: Int8Array, uint8: Uint8Array };
const POWERS = Array.from({ length: 32 }, (_, i) => 2 ** (Math.max(i, 1) - 25));

/* What the 16 bits of a half-precision number stand for. */
const half = (bits) => {
  const exponent = (bits >> 10) & 31, size = (bits & 1023) + (exponent && 1024);
  return (bits & 0x8000 ? -size : size) * POWERS[exponent];
};
const halves = (bits) => {
  const numbers = new Float64Array(bits.length);
  for (let i = 0; i < bits.length; i++) numbers[i] = half(bits[i]);
  return numbers;
};

/* A promise of the brain: objects and lists of numbers and typed arrays. Its script comes from the book's own
   files, when it is first asked for. */
const load = async () => {
  if (!self.vmcBrain) await fetchVendored("brain.js");
  const { tree, arrays } = self.vmcBrain, buffer = await unzip(arrays).arrayBuffer();
  const revive = (_, it) => {
    if (!it?.kind) return it;
    const array = new KINDS[it.kind](buffer, it.at, it.length);
    return it.kind === "float16" ? halves(array) : array;
  };
  const brain = JSON.parse(tree, revive);
  delete self.vmcBrain; // megabytes of text
  for (let i = 3; i < brain.lab.length; i++) if (i % 99 > 2) brain.lab[i] += brain.lab[i - 3];
  return brain;
};

let loading; // unless that fails, once
export const unpack = () => (loading ??= load().catch((error) => {
  loading = null;
  throw error;
}));
