/* MuJoCo, compiled to WebAssembly: a promise of it, from the book's own files, when an arm is first
   started. */
import { fetchVendored, unzip } from "../vendored.js";

const load = async () => {
  if (typeof loadMujoco === "undefined") await fetchVendored("mujoco.js");
  const wasmBinary = await unzip(loadMujoco.wasm).arrayBuffer();
  return loadMujoco({ wasmBinary, locateFile: (name) => name }); // nothing is left to locate
};

let loading; // unless that fails, once
const forget = (error) => {
  loading = null;
  throw error;
};

export const engine = () => (loading ??= load().catch(forget));
