/* The stages of the ventral stream as a network in WebAssembly (convolution.wat), whose memory holds weights and maps. */
export const WIDTH = 48; // of what it sees, in pixels

const compile = (code) => {
  try {
    return new WebAssembly.Module(code);
  } catch (cause) {
    throw new Error("this browser runs no WebAssembly with SIMD; those since 2023 do, unless it is switched off", { cause });
  }
};

/* What puts W (filters, channels, 3, 3) into the order (eight filters, row, column, channel, filter). */
const interleave = (W, channels, weights) => {
  for (let at = 0, f = 0; at < W.length; f++)
    for (let c = 0; c < channels; c++)
      for (let tap = 0; tap < 9; tap++)
        weights[8 * (((f >> 3) * 9 + tap) * channels + c) + (f & 7)] = W[at++];
};

/* A network of stages: `run` turns what stands in `input` (50, 50, 3) into `output` (size + 2, size + 2, channels), both
   with a border of zeros. */
export const build = (code, stages) => {
  const { memory, stage } = new WebAssembly.Instance(compile(code)).exports;
  let free = 0, size = WIDTH, channels = 3;
  const numbers = (count) => {
    const some = new Float32Array(memory.buffer, free, count);
    free += some.byteLength;
    return some;
  };
  const map = () => numbers((size + 2) ** 2 * channels), input = map();
  let output = input;
  const calls = stages.map(({ W, b }) => {
    const weights = numbers(W.length), biases = numbers(b.length), given = [output, weights, biases];
    interleave(W, channels, weights);
    biases.set(b);
    const shape = [size, channels, b.length];
    [size, channels] = [size / 2, b.length];
    output = map();
    return [...[...given, output].map((part) => part.byteOffset), ...shape];
  });
  return { input, output, size, channels, run: () => calls.forEach((call) => stage(...call)) };
};
