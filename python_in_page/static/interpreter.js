/* Python, compiled to WebAssembly, in a worker: loaded from the book's own files when a reader first
   writes or has something checked. */
const vmcPython = (() => {
  "use strict";

  const SIZE = "12 MB";
  const limit = { seconds: 10 }; // for one answer

  /* The worker's own code: first it is sent { files }, then questions for `python_in_page.grader`. */
  const work = () => {
    let check;
    const fetchNow = self.fetch;
    const start = async (files) => {
      self.fetch = async (address) => { // whatever Pyodide asks for lies in `files`
        const name = String(address.url ?? address).split("/").pop();
        const { body } = await fetchNow(`data:application/gzip;base64,${files[name]}`);
        const type = name.endsWith(".wasm") ? "application/wasm" : "application/octet-stream";
        return new Response(body.pipeThrough(new DecompressionStream("gzip")), { headers: { "content-type": type } });
      };
      for (const name of ["pyodide.js", "pyodide.asm.js"]) (0, eval)(await (await fetch(name)).text());
      const quiet = { stdin: () => null, stdout: () => {}, stderr: () => {} };
      const python = await loadPyodide({ indexURL: "http://page.invalid/", packages: ["numpy"], ...quiet });
      python.unpackArchive(await (await fetch("library.zip")).arrayBuffer(), "zip");
      const grader = python.pyimport("python_in_page.grader");
      check = ([above, typed, name]) =>
        (name ? grader.check(python.toPy(above), typed, name) : grader.run(python.toPy(above), typed)).toJs();
    };
    onmessage = async ({ data }) => {
      try {
        postMessage({ value: data.files ? await start(data.files) : check(data) });
      } catch (error) {
        postMessage({ error: `Python stopped: ${`${error.message ?? error}`.trim().split("\n").pop()}` });
      }
    };
  };

  /* A worker: `ask` promises its answer to one question, unless it comes to its `end`, for a reason. */
  const launch = () => {
    const worker = new Worker(URL.createObjectURL(new Blob([`(${work})()`], { type: "text/javascript" })));
    let end;
    const ended = new Promise((_, reject) => {
      end = (reason) => {
        worker.terminate();
        reject(new Error(reason));
      };
    });
    ended.catch(() => {}); // nobody may be waiting
    worker.onerror = (event) => end(`Python stopped: ${event.message}`);
    const answered = (resolve) => {
      worker.onmessage = ({ data }) => ("error" in data ? end(data.error) : resolve(data.value));
    };
    const ask = (question) => {
      worker.postMessage(question);
      return Promise.race([ended, new Promise(answered)]);
    };
    const load = async () => {
      if (!self.vmcPythonFiles) await vmcVendored("python.js");
      return ask({ files: vmcPythonFiles });
    };
    const ready = Promise.race([ended, load()]);
    ready.catch(stop); // so that the next one tries again
    return { ask, end, ready };
  };

  let running;
  const start = () => (running ??= launch());
  const stop = (reason = "Stopped.") => {
    running?.end(reason.message ?? reason);
    running = null;
  };

  /* The answer to a question; `say` is told what it waits for. Where it takes too long or is stopped
     there is none, and Python starts anew. */
  const answer = async (question, say) => {
    const { ready, ask } = start();
    say(self.vmcPythonFiles ? "Starting Python …" : `Loading Python (${SIZE}, part of this book) …`);
    await ready;
    say("Checking …");
    const late = setTimeout(stop, 1000 * limit.seconds, `Stopped after ${limit.seconds} s. Does a loop never end?`);
    try {
      return await ask(question);
    } catch (error) {
      stop();
      start();
      throw error;
    } finally {
      clearTimeout(late);
    }
  };

  let last = Promise.resolve();
  const check = (question, say) => {
    const next = () => answer(question, say);
    return (last = last.then(next, next));
  };
  return { check, stop, start, limit };
})();
