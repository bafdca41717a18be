/* MuJoCo, compiled to WebAssembly: a promise of it, from the book's own files, when an arm is first
   started. */
import { fetchVendored, once, unzip } from "../vendored.js";

export const engine = once(async () => {
  if (typeof loadMujoco === "undefined") await fetchVendored("mujoco.js");
  const wasmBinary = await unzip(loadMujoco.wasm).arrayBuffer();
  return loadMujoco({ wasmBinary, locateFile: (name) => name }); // nothing is left to locate
});
