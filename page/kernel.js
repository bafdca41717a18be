/* The browser's end of widgets that a kernel answers (vmc_lib.show.live). What it keeps serves the whole window,
   of which several notebooks, and so several kernels, may have a part. */
import { lend } from "./vendored.js";

export const GONE = "The kernel has gone: Run > Run All Cells.";
const lenders = new Set(); // kernels that send a vendored script to whoever needs it
const vendored = new Map(); // promises of these, by name

const run = (text) => {
  const { define } = self; // a module loader, where there is one: a script is to find none
  self.define = undefined;
  const tag = document.createElement("script");
  tag.textContent = text;
  document.head.append(tag);
  tag.remove();
  self.define = define;
};

/* `ask(question, value)` promises the kernel's answer, or an { error }; so does every question that
   is open when the kernel goes, of which `onleave` hears. */
const connect = (channel, scripts) => {
  const pending = new Map();
  const settle = (id, reply) => {
    pending.get(id)?.(reply);
    pending.delete(id);
  };
  const ask = (question, value) =>
    new Promise((resolve) => {
      const id = `${Math.random()}`;
      pending.set(id, resolve);
      try {
        channel.send({ id, question, value });
      } catch {
        ask.leave(); // the connection has been closed
      }
      if (ask.left) settle(id, { error: GONE });
    });
  ask.leave = () => {
    ask.left = true;
    lenders.delete(ask);
    channel.off(null, null, ask);
    for (const id of [...pending.keys()]) settle(id, { error: GONE });
    ask.onleave?.();
  };
  channel.on("msg:custom", ({ id, answer, error }) => settle(id, error === undefined ? answer : { error }), ask);
  channel.on("comm_live_update", ask.leave, ask);
  ask.vendored = scripts; // that this kernel has
  lenders.add(ask);
  return ask;
};

/* A vendored script, from whichever kernel has it; of a kernel that goes, another takes the place. */
const borrow = async (name) => {
  for (const ask of [...lenders].reverse()) {
    const text = ask.vendored.includes(name) && (await ask("script", name));
    if (typeof text === "string") return run(text);
  }
  throw Object.assign(new Error(GONE), { name: "KernelGone" });
};
const fetchVendored = (name) => {
  const forget = (error) => {
    vendored.delete(name);
    throw error;
  };
  if (!vendored.has(name)) vendored.set(name, borrow(name).catch(forget));
  return vendored.get(name);
};
lend(fetchVendored);

/* Keys are the controls' own, but for shortcuts; Escape leads back to the notebook. */
const keepKeys = (event) => {
  const { key, ctrlKey, metaKey, altKey, shiftKey } = event;
  if (key === "Escape") event.currentTarget.closest(".jp-Notebook")?.focus();
  else if (!(ctrlKey || metaKey || altKey || (shiftKey && key === "Enter"))) event.stopPropagation();
};

/* What a widget shows; of a second view the labels are for its own controls. */
let views = 0;
const view = (markup) => {
  const { content } = Object.assign(document.createElement("template"), { innerHTML: markup });
  if (document.getElementById(content.firstElementChild.id)) {
    views++;
    for (const name of ["id", "name", "for"])
      for (const one of content.querySelectorAll(`.vmc-controls [${name}]`))
        one.setAttribute(name, `${one.getAttribute(name)}-${views}`);
  }
  return content;
};

/* Show a widget in an element: its markup, which `start` moves. */
export const render = async ({ model, el }, start) => {
  const channel = await model.widget_manager.get_model(model.get("channel"));
  const ask = connect(channel, model.get("vendored"));
  el.replaceChildren(view(model.get("page")));
  el.addEventListener("keydown", keepKeys);
  const end = start(el.firstElementChild, ask, model.get("first"), model);
  return () => {
    ask.leave();
    end?.();
  };
};
