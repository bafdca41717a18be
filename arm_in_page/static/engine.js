/* MuJoCo, compiled to WebAssembly: a promise of it, from the book's own files, when an arm is first
   started. */
const vmcEngine = (() => {
  "use strict";

  const load = async () => {
    if (typeof loadMujoco === "undefined") await vmcVendored("mujoco.js");
    const packed = await fetch(`data:application/gzip;base64,${loadMujoco.wasm}`);
    const stream = packed.body.pipeThrough(new DecompressionStream("gzip"));
    const wasmBinary = await new Response(stream).arrayBuffer();
    return loadMujoco({ wasmBinary, locateFile: (name) => name }); // nothing is left to locate
  };

  let loading;
  return () => (loading ??= load());
})();
