/* Python, compiled to WebAssembly, in a worker: loaded from the book's own files when a reader first
   clicks to write, writes or has something checked; what draws plots, when a demo is first to be drawn. */
import { fetchVendored, unzip } from "../vendored.js";

const SIZES = { "python.js": "11 MB", "plots.js": "8 MB" };
export const MEGABYTES = Object.values(SIZES).reduce((total, size) => total + parseFloat(size), 0);
const HOLDS = { "python.js": "library.zip", "plots.js": "plots.zip" }; // a file of each
export const limit = { seconds: 10, opening: 60 }; // for one answer, and for the frame

/* The worker's own code: it is sent the port on which it is asked; there first { files }, and more of
   them when it is to draw; and questions: a module of `page.python`, a function of it, and what
   that is given. */
const work = () => {
  /* What reaches further than the port goes before any line of a reader's runs; the frame's policy forbids it, too. */
  const REACHES = new RegExp("^(fetch|XMLHttp|WebSocket|WebTransport|EventSource|Broadcast|importScripts|postMessage|navigator$" +
    "|(Shared)?Worker$|indexedDB|IDB|[cC]ache|Storage|FileSystem|RTC)");
  const seal = () => {
    for (let place = self; place; place = Object.getPrototypeOf(place))
      for (const name of Object.getOwnPropertyNames(place)) if (REACHES.test(name)) delete place[name];
  };
  let python, files;
  self.fetch = async (address) => { // whatever Pyodide asks for lies in `files`
    const name = String(address.url ?? address).split("/").pop();
    const type = name.endsWith(".wasm") ? "application/wasm" : "application/octet-stream";
    return new Response(unzip(files[name]).body, { headers: { "content-type": type } });
  };
  const unpack = async (name) => python.unpackArchive(await unzip(files[name]).arrayBuffer(), "zip");
  const start = async () => {
    for (const name of ["pyodide.js", "pyodide.asm.js"]) (0, eval)(await unzip(files[name]).text());
    const quiet = { stdin: () => null, stdout: () => {}, stderr: () => {} };
    python = await loadPyodide({ indexURL: "http://page.invalid/", packages: ["numpy"], ...quiet });
    await unpack("library.zip");
    python.pyimport("page.python.grader");
    seal();
  };
  const load = async (more) => {
    files = more;
    if (!python) return start();
    await Promise.all(["plots.zip", "figures.zip"].map(unpack));
    python.pyimport("page.python.demos");
  };
  const answer = ([module, name, ...given]) => {
    const asked = python.pyimport(`page.python.${module}`)[name];
    return asked(...given.map((one) => python.toPy(one))).toJs({ dict_converter: Object.fromEntries });
  };
  onmessage = ({ ports: [port] }) => {
    port.onmessage = async ({ data }) => {
      try {
        port.postMessage({ value: data.files ? await load(data.files) : answer(data) });
      } catch (error) {
        port.postMessage({ error: `Python stopped: ${`${error.message ?? error}`.trim().split("\n").pop()}` });
      }
    };
    port.postMessage({});
  };
};

/* Its frame has no origin, so neither a host's cookies nor what a browser keeps, and a policy that reaches
   nothing. Its page, and no other, sends it a worker's code and port, or nothing: the last worker ends. The
   page's own policy names the frame's script by its sum (book/_ext/policy.py). */
const OPEN = "let worker; onmessage = ({ source, data, ports }) => { if (source !== parent) return; " +
  "worker?.terminate(); if (data) " +
  "(worker = new Worker(URL.createObjectURL(new Blob([data])))).postMessage(0, ports); }";
const POLICY = "default-src 'none'; script-src 'unsafe-eval'; worker-src blob:";
const FORBIDDEN = "The page’s host forbids Python: its policy must be the one that the book’s README states.";
const openFrame = () => new Promise((resolve) => {
  const frame = document.createElement("iframe");
  frame.setAttribute("sandbox", "allow-scripts");
  frame.srcdoc = `<script>${OPEN}<\/script><meta http-equiv="Content-Security-Policy" content="${POLICY}">`;
  Object.assign(frame, { hidden: true, title: "Python", onload: () => resolve(frame.contentWindow) });
  document.body.append(frame);
});
let frame;
const send = async (code, ports) => (await (frame ??= openFrame())).postMessage(code, "*", ports);

/* A worker: `ask` promises its answer to one question, unless it comes to its `end`, for a reason. What it
   answers is data, whatever it says: a reader's lines may have spoken for it. */
const launch = () => {
  const { port1: port, port2 } = new MessageChannel();
  let end;
  const ended = new Promise((_, reject) => {
    end = (reason) => {
      clearTimeout(late);
      port.close();
      send("");
      reject(new Error(reason));
    };
  });
  ended.catch(() => {}); // nobody may be waiting
  const nextAnswer = () => new Promise((resolve) => {
    port.onmessage = ({ data }) => (data?.error === undefined ? resolve(data?.value) : end(data.error));
  });
  const open = nextAnswer(), late = setTimeout(end, 1000 * limit.opening, FORBIDDEN);
  open.then(() => clearTimeout(late));
  send(`const unzip = ${unzip};(${work})()`, [port2]);
  const ask = (question) => {
    port.postMessage(question);
    return Promise.race([ended, nextAnswer()]);
  };
  const load = async (script) => {
    if (!here(script)) await fetchVendored(script);
    await open;
    return ask({ files: vmcPythonFiles });
  };
  const loaded = {};
  const stopAndThrow = (error) => {
    stop(error); // so that the next one tries again
    throw error;
  };
  const ready = (script) => (loaded[script] ??= Promise.race([ended, load(script)]).catch(stopAndThrow));
  ready("python.js").catch(() => {}); // whoever asks is told
  return { ask, end, ready };
};
const here = (script) => self.vmcPythonFiles?.[HOLDS[script]];

let running;
export const start = () => (running ??= launch());
export const stop = (reason = "Stopped.") => {
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

/* One question after the other. A `signal` aborts its own question alone: the one that runs, or waits. */
let last = Promise.resolve(), asked = 0;
export const ask = (question, say, signal) => {
  const end = () => stop();
  const next = async () => {
    signal?.throwIfAborted();
    signal?.addEventListener("abort", end);
    return answer(question, say).finally(() => signal?.removeEventListener("abort", end));
  };
  if (asked++ && signal) say("Waiting for what runs now …");
  const turn = (last = last.then(next, next).finally(() => asked--));
  const aborted = new Promise((_, reject) => signal?.addEventListener("abort", () => reject(signal.reason)));
  return Promise.race([turn, aborted]);
};
