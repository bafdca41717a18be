/* Demos that the page's Python draws: by a law that the reader has changed above them, and between a
   slider's stops. Where it cannot, or is not asked, the nearest picture of the book stands. And arms
   that plan by such a law. */
import { address } from "../demo/address.js";
import { clean, cleanMessages } from "./drawn.js";
import * as grade from "./grade.js";
import * as python from "./interpreter.js";

const STEP = 0.1; // of a slider, from one stop to the next
const FREE = "The sliders now take any value.";
const LAW = "law."; // before a cell's name, in an address
const LONGEST = 20_000; // signs of a law in an address: the browser keeps five million in all

const inCode = (names) => names.map((name) => `\`${name.replaceAll("`", "").slice(0, 60)}\``).join(", "); // Markdown, as all that is said here
const ownCells = (above) => above.filter((one) => grade.runHere(one) !== grade.book(one));
const figures = []; // that use laws: [a figure's cell, the cells of laws and those above it, what it needs of them]

/* The cells of the chapter's code before one of them, and the laws after it: it may run these, too. */
const codeOf = (cell) => [...grade.cellsAbove(cell), ...[...document.querySelectorAll(".tag_runs-in-page")]
  .filter((law) => cell.compareDocumentPosition(law) & 4)];

/* The figures that may run a cell's law, `typed` in it: see `page.python.grader.run`. */
grade.users.figures = (law, typed) => figures.filter(([, above]) => above.includes(law)).map(([cell, above, needs]) =>
  [cell.querySelector(".vmc-number")?.textContent.replace(/\D*/, "") ?? "", above.map((one) => (one === law ? typed : grade.runHere(one))),
    above.map(grade.book), needs]);

const BACK = '<button type="button" name="back" hidden>Back to the book’s</button>';

/* A line below controls: what it says, and its buttons. */
const addLine = (controls, buttons) => {
  const line = document.createElement("p");
  line.className = "vmc-law";
  line.innerHTML = `<span role="status"></span> ${buttons}`;
  controls.after(line);
  return [...line.children];
};

/* `update` at once where the reader has run a cell above; the book's cells again, by the button `back`. */
const watch = (above, back, update) => {
  document.addEventListener("vmc-run", ({ target }) => above.includes(target) && update());
  back.addEventListener("click", () => {
    back.closest(".vmc-demo, .vmc-live").querySelector("input, select").focus(); // the button goes
    for (const one of ownCells(above)) one.dispatchEvent(new Event("vmc-back"));
  });
};

/* Where a demo's controls stand, by name: see `page.python.demos.draw`. */
const places = (demo) => {
  const stand = {};
  for (const { type, checked, name, id, value } of demo.querySelectorAll("[data-stride]"))
    if (type !== "radio" || checked)
      stand[(name || id).slice(demo.id.length + 1)] = type === "checkbox" ? +checked : +value;
  return stand;
};

/* A demo that may be drawn by the reader's laws, and by sliders between their stops. */
class Follower {
  laws = []; // of the reader's, those that it needs, by name
  busy = false;
  wanted = null; // the last place that was asked for, until it is drawn; those that the hand only passes are left out

  constructor(demo) {
    const cell = demo.closest(".cell"), above = codeOf(cell);
    figures.push([cell, above, grade.book(cell)]);
    const [status, run, back] = addLine(demo.querySelector(".vmc-controls"),
      `<button type="button" name="run" hidden>Run it</button> ${BACK}`);
    const between = document.createElement("button");
    Object.assign(between, { type: "button", className: "vmc-any", textContent: `Any value (loads Python, ${python.MEGABYTES} MB)` });
    demo.querySelector(".vmc-more > form").after(between);
    const sliders = [...demo.querySelectorAll("[data-between]")];
    Object.assign(this, { demo, cell, above, status, run, back, between, sliders });
    between.hidden = !sliders.length;
    between.addEventListener("click", () => {
      sliders[0].focus(); // the button goes
      for (const one of followers) (one.free(), one.say(FREE));
      this.ask(0, () => {}, {}, true); // Python is made ready for it
    });
    watch(above, back, () => this.update());
    const name = (one) => one.querySelector("form[data-cell]")?.dataset.cell; // an exercise has none
    demo.vmcLaws = () => ownCells(above).filter(name).map((one) => [LAW + name(one), grade.runHere(one)]);
  }

  say(text) {
    if (this.said !== text) this.status.innerHTML = grade.inline((this.said = text));
  }

  /* The code above, as the reader has it and as the book has it, and the demo's own cell. */
  get code() {
    return [this.above.map(grade.runHere), this.above.map(grade.book), grade.book(this.cell)];
  }

  /* Say what it runs, and where its sliders stand. */
  sayLaws() {
    const { laws, sliders, between } = this, free = sliders.length && between.hidden ? FREE : "";
    this.say(laws.length ? `This demo runs **your** ${inCode(laws)}.` : free);
  }

  show({ parts, texts, error }, place, draw) {
    const { demo, laws } = this;
    if (error) return this.fail(`${laws.length ? `Your \`${laws.join(", ")}\`` : "Python"} stops: ${error}.`, place, draw);
    draw(parts, { clean, cleanMessages });
    for (const one of followers) one.free(); // Python is there
    for (const [name, text] of Object.entries(texts)) {
      const input = demo.querySelector(`#${CSS.escape(`${demo.id}-${name}`)}`);
      input.setAttribute("aria-valuetext", text);
      input.nextElementSibling.textContent = text;
    }
    this.sayLaws();
  }

  fail(why, place, draw) {
    this.book(place, draw);
    this.say(`${why} This is the book’s.`);
  }

  async drawWanted() {
    const { demo } = this;
    this.busy = true;
    demo.setAttribute("aria-busy", "true");
    while (this.wanted) {
      const { wanted } = this, [place, draw, ready] = wanted;
      const isLatest = () => this.wanted === wanted;
      try {
        const question = ["demos", "draw", ...this.code, demo.id, ready ? null : places(demo), demo.vmc.data ?? ""];
        const answer = await python.ask(question, (text) => this.wanted && this.say(text));
        if (isLatest()) this.show(answer, place, draw);
      } catch (error) {
        if (isLatest()) this.fail(error.message, place, draw);
      }
      if (isLatest()) this.wanted = null;
    }
    this.busy = false;
    demo.removeAttribute("aria-busy");
  }

  ask = (place, draw, exact, ready = false) => {
    const { laws, wanted } = this, off = this.sliders.some(({ value }) => value % 1);
    if (!laws.length) this.book(place, draw, exact);
    this.wanted = laws.length || off || ready ? [place, draw, ready] : null;
    if (this.wanted && !this.busy) this.drawWanted();
    if (wanted && !this.wanted) this.sayLaws(); // and no longer what it waits for
  };

  /* From now on the demo asks here, and no longer the book. */
  take() {
    const { vmc } = this.demo;
    if (vmc.ask !== this.ask) [this.book, vmc.ask] = [vmc.ask, this.ask];
  }

  /* What the reader's cells have become. */
  async update() {
    const none = [];
    this.take();
    Object.assign(this, { laws: none, wanted: null });
    this.run.hidden = true;
    this.say("");
    let laws = none, why = "";
    try {
      if (ownCells(this.above).length) laws = await python.ask(["grader", "changed_names", ...this.code], () => {});
    } catch ({ message }) {
      why = message;
    }
    if (this.laws !== none) return; // the reader has run another since
    this.laws = laws;
    this.say(why);
    this.back.hidden = !this.laws.length;
    this.demo.vmc.show();
  }

  /* Its sliders take any value. */
  free() {
    this.take();
    this.sliders.forEach((input) => (input.step = STEP));
    this.between.hidden = true;
  }

  /* A link has brought laws, by their cells' names. */
  offer(laws) {
    this.say(`This link brings another ${inCode([...laws.keys()])}. Read it in its cell first.`);
    this.run.hidden = false;
    this.run.onclick = () => {
      this.run.hidden = true;
      for (const [name, lines] of laws) {
        cellOf(name).dispatchEvent(new CustomEvent("vmc-take", { detail: lines }));
        cellOf(name).querySelector("form").requestSubmit();
      }
    };
  }
}

/* An arm whose physics runs in the page (page/arm): it plans by the weights of the reader's law. */
const addLaw = (box) => {
  const { law } = box.dataset, above = codeOf(box.closest(".cell")), form = box.querySelector("form");
  figures.push([box.closest(".cell"), above, law]);
  const [status, back] = addLine(form, BACK);
  const say = (text) => (status.innerHTML = grade.inline(text));
  let mine = false;
  watch(above, back, async () => {
    try {
      const question = ["grader", "changed_names", above.map(grade.runHere), above.map(grade.book), law];
      const laws = ownCells(above).length ? await python.ask(question, () => {}) : [];
      mine = laws.length > 0 && ownCells(above).length > 0; // the reader may have gone back meanwhile
      say(mine ? `This arm plans by **your** ${inCode([law])}: let it reach.` : "");
    } catch (error) {
      mine = false;
      say(error.message);
    }
    back.hidden = !mine;
    form.querySelector("fieldset").dispatchEvent(new Event("input", { bubbles: true })); // it plans anew
  });
  box.vmcLaw = async ({ target, points }) => {
    if (!mine) return null;
    const question = ["grader", "call", above.map(grade.runHere), law, [target, points]];
    const { answer, error } = await python.ask(question, () => {}).catch(({ message }) => ({ error: message }));
    if (answer?.length === points.length && answer.every(Number.isFinite)) return answer;
    say(`Your \`${law}\` ${error ? `stops: ${error}` : `gives no ${points.length} weights`}. This is the book’s.`);
    return null;
  };
};

const cellOf = (name) => document.querySelector(`form[data-cell="${CSS.escape(name)}"]`)?.closest(".cell");

/* The laws that an address brings are shown beside their cells, and run when the reader asks for it. */
const bring = () => {
  const [id, query] = address();
  const laws = [...new URLSearchParams(query)].filter(([key, text]) => key.startsWith(LAW) && text).map(([key, text]) => [key.slice(LAW.length), text]);
  if (!laws.length) return;
  const follower = followers.find(({ demo }) => demo.id === id);
  followers.forEach(({ run }) => (run.hidden = true)); // the lines of an earlier link are gone
  if (laws.some(([, lines]) => lines.length > LONGEST)) return follower?.say("This link’s lines are too long for a cell: none is taken.");
  const known = new Map(laws.filter(([name]) => cellOf(name))), unknown = laws.map(([name]) => name).filter((name) => !known.has(name));
  for (const [name, lines] of known) cellOf(name).dispatchEvent(new CustomEvent("vmc-bring", { detail: lines }));
  if (known.size) follower?.offer(known);
  else follower?.say(`This link brings a law for ${inCode(unknown)}; no cell of this page defines it.`);
};

let followers = [];
addEventListener("DOMContentLoaded", () => {
  const demos = [...document.querySelectorAll(".tag_draws-in-page .vmc-demo:has(> script)")];
  followers = demos.map((demo) => new Follower(demo));
  document.querySelectorAll(".vmc-live[data-law]").forEach(addLaw);
  bring();
});
addEventListener("hashchange", bring);
