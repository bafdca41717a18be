/* MuJoCo, compiled to WebAssembly: a promise of it, from the book's own files, when an arm is first
   started. */
const vmcEngine = (() => {
  "use strict";

  const load = async () => {
    if (typeof loadMujoco === "undefined") await vmcVendored("mujoco.js");
    const wasmBinary = await vmcUnzip(loadMujoco.wasm).arrayBuffer();
    return loadMujoco({ wasmBinary, locateFile: (name) => name }); // nothing is left to locate
  };

  let loading; // unless that fails, once
  const forget = (error) => {
    loading = null;
    throw error;
  };
  return () => (loading ??= load().catch(forget));
})();
