/* The browser's end of widgets that a kernel answers (vmc_lib.show.live). */
const GONE = "The kernel has gone: Run > Run All Cells.";
const RUNNING = "The chapter is still running: the controls move as soon as it can answer.";
const { loaded, lenders, vendored } = (globalThis.vmcScripts ??= {
  loaded: new Set(), // names of the scripts that have run, once for the whole window
  lenders: new Set(), // kernels that send a vendored script to whoever needs it
  vendored: new Map(), // promises of these, by name
});

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
const connect = (channel, vendored) => {
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
  ask.vendored = vendored;
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

/* The first answer of a kernel. Until the browser has a channel beside the cells, a question waits
   behind them; so it is repeated. */
const firstAnswer = async (ask) => {
  for (let wait = 250, answer; ; wait *= 2) {
    const later = new Promise((resolve) => setTimeout(resolve, wait));
    if ((answer = await Promise.race([ask("ping"), later]))) return answer;
  }
};

/* A demo's states: `draw` is given the `first` at once, then what the kernel answers. Of places that
   come while it works, the last wins. An error stands below the picture; the still follows the reader. */
const states = (ask, box, first, model) => {
  let wanted, working, resting, last;
  const views = () =>
    [...box.querySelectorAll(".vmc-scene")].map((div) => vmcScene(div).viewer?.capture_image() ?? "");
  const work = async (draw) => {
    working = true;
    box.setAttribute("aria-busy", "true");
    while (wanted !== undefined) {
      const place = (last = wanted);
      wanted = undefined;
      const state = await ask(place === model.get("place") ? "picture" : "state", place);
      if (ask.left) break;
      box.querySelector(".vmc-error").textContent = state.error ?? "";
      if (!state.error) draw(state);
    }
    working = false;
    box.removeAttribute("aria-busy");
    resting = setTimeout(() => ask("still", views()), 1000);
  };
  const show = (place, draw) => {
    if (first) return draw(first), (first = null), (last = place);
    clearTimeout(resting);
    wanted = place;
    if (!working) work(draw);
  };
  /* With words that say why, the controls are closed. */
  const close = (words) => {
    box.querySelector(".vmc-kernel").textContent = words;
    box.toggleAttribute("data-closed", words);
    for (const control of box.querySelectorAll("[data-stride], [data-stride] ~ .vmc-play"))
      control.disabled = words;
  };
  close(RUNNING);
  ask.onleave = () => close(GONE);
  /* The controls go where the kernel or another view has put them, but for where the last answer came from. */
  show.follow = () => {
    const place = model.get("place");
    if (place === last) return;
    for (const input of box.querySelectorAll("[data-stride]")) {
      const at = (length) => Math.floor(place / input.dataset.stride) % length;
      if (input.type === "range") input.value = at(+input.max + 1);
      else if (input.type === "checkbox") input.checked = at(2) === 1;
      else if (input.type === "radio") input.checked = +input.value === at(input.closest("fieldset").elements.length);
      else input.selectedIndex = at(input.length);
    }
    box.dispatchEvent(new Event("input", { bubbles: true }));
  };
  show.ready = firstAnswer(ask).then(() => close(ask.left ? GONE : ""));
  return show;
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

/* Keys are the controls' own, but for shortcuts; Escape leads back to the notebook. */
const keepKeys = (event) => {
  const { key, ctrlKey, metaKey, altKey, shiftKey } = event;
  if (key === "Escape") event.currentTarget.closest(".jp-Notebook")?.focus();
  else if (!(ctrlKey || metaKey || altKey || (shiftKey && key === "Enter"))) event.stopPropagation();
};

export default {
  async render({ model, el }) {
    const channel = await model.widget_manager.get_model(model.get("channel"));
    const ask = connect(channel, model.get("vendored"));
    el.replaceChildren(view(model.get("page")));
    el.addEventListener("keydown", keepKeys);
    globalThis.vmcKernel = fetchVendored;
    for (const [name, text] of Object.entries(model.get("scripts")))
      if (!loaded.has(name)) run(text, loaded.add(name));
    const [box, first] = [el.firstElementChild, model.get("first")];
    const [start] = model.get("start").match(/^vmc\w+$/); // a name, and no other code
    const show = first && states(ask, box, first, model);
    const end = new Function(`return ${start}`)()(box, show, ask);
    const follow = () => show?.follow();
    follow();
    model.on("change:place", follow);
    return () => {
      model.off("change:place", follow);
      ask.leave();
      end?.();
    };
  },
};
