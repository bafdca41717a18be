/* Python, compiled to WebAssembly, in a worker: loaded from the book's own files when a reader first
   clicks to write, writes or has something checked; what draws plots, when a demo is first to be drawn. */
const vmcPython = (() => {
  "use strict";

  const SIZES = { "python.js": "11 MB", "plots.js": "8 MB" };
  const HOLDS = { "python.js": "library.zip", "plots.js": "plots.zip" }; // a file of each
  const limit = { seconds: 10 }; // for one answer

  /* The worker's own code: first it is sent { files }, and more of them when it is to draw; and
     questions: a module of `python_in_page`, a function of it, and what that is given. */
  const work = () => {
    let python, files;
    const fetchNow = self.fetch;
    self.fetch = async (address) => { // whatever Pyodide asks for lies in `files`
      const name = String(address.url ?? address).split("/").pop();
      const { body } = await fetchNow(`data:application/gzip;base64,${files[name]}`);
      const type = name.endsWith(".wasm") ? "application/wasm" : "application/octet-stream";
      return new Response(body.pipeThrough(new DecompressionStream("gzip")), { headers: { "content-type": type } });
    };
    const unpack = async (name) => python.unpackArchive(await (await fetch(name)).arrayBuffer(), "zip");
    const start = async () => {
      for (const name of ["pyodide.js", "pyodide.asm.js"]) (0, eval)(await (await fetch(name)).text());
      const quiet = { stdin: () => null, stdout: () => {}, stderr: () => {} };
      python = await loadPyodide({ indexURL: "http://page.invalid/", packages: ["numpy"], ...quiet });
      await unpack("library.zip");
      python.pyimport("python_in_page.grader");
    };
    const load = async (more) => {
      files = more;
      if (!python) return start();
      await Promise.all(["plots.zip", "figures.zip"].map(unpack));
      python.pyimport("python_in_page.demos");
    };
    const answer = ([module, name, ...given]) => {
      const asked = python.pyimport(`python_in_page.${module}`)[name];
      return asked(...given.map((one) => python.toPy(one))).toJs({ dict_converter: Object.fromEntries });
    };
    onmessage = async ({ data }) => {
      try {
        postMessage({ value: data.files ? await load(data.files) : answer(data) });
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
    const load = async (script) => {
      if (!here(script)) await vmcVendored(script);
      return ask({ files: vmcPythonFiles });
    };
    const loaded = {};
    const ready = (script) => (loaded[script] ??= Promise.race([ended, load(script)]));
    ready("python.js").catch(stop); // so that the next one tries again
    return { ask, end, ready };
  };
  const here = (script) => self.vmcPythonFiles?.[HOLDS[script]];

  let running;
  const start = () => (running ??= launch());
  const stop = (reason = "Stopped.") => {
    running?.end(reason.message ?? reason);
    running = null;
  };

  /* The answer to a question; `say` is told what it waits for. Where it takes too long or is stopped
     there is none, and Python starts anew. */
  const answer = async (question, say) => {
    const { ready, ask } = start(), draws = question[0] !== "grader";
    for (const script of ["python.js", ...(draws ? ["plots.js"] : [])]) {
      say(here(script) ? "Starting Python …" : `Loading Python (${SIZES[script]}, part of this book) …`);
      await ready(script);
    }
    say(draws ? "" : "Checking …");
    const seconds = question[0] === "measure" ? 6 * limit.seconds : limit.seconds; // no code of the reader's
    const late = setTimeout(stop, 1000 * seconds, `Stopped after ${seconds} s. Does a loop never end?`);
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
  const ask = (question, say) => {
    const next = () => answer(question, say);
    return (last = last.then(next, next));
  };
  return { ask, stop, start, limit };
})();
