/* Exercises in which the reader writes a function: the empty one becomes a field to write in, and the
   page's Python grades it. So does a mechanism's cell, where it can run in the page, by its *Edit*: its
   lines run. What was typed, and what was said of it, is there again when the page is. */
import { setEquations } from "../book/equations.js";
import { memory } from "../demo/questions.js";
import { disable } from "./disable.js";
import * as python from "./interpreter.js";
import { onKey, type } from "./typing.js";

const escape = (text) => `${text}`.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt()};`);
const MARKS = /`([^`]+)`|\$([^$]+)\$|\*\*([^*]+)\*\*|\*([^*]+)\*/g;

/* A line of Markdown as HTML, as vmc_lib.show.figures.inline has it. */
export const inline = (text) =>
  escape(text).replace(MARKS, (_, code, tex, strong, words) =>
    code ? `<code>${code}</code>` : tex ? `<span class="math inline">\\(${tex.trim()}\\)</span>`
      : strong ? `<strong>${strong}</strong>` : `<em>${words}</em>`);

const field = (cell) => cell.querySelector("textarea");
export const book = (cell) => field(cell)?.defaultValue ?? cell.querySelector("pre").textContent;

/* What a cell's reader ran last, ever and since the page opened; else the book's. What only stands there may be a link's. */
const keptRun = (cell) => field(cell)?.ran ?? book(cell);
export const runHere = (cell) => field(cell)?.lastRun ?? book(cell);

/* The cells of the chapter's code before one of them; no solution is among them. */
export const cellsAbove = (cell) =>
  [...document.querySelectorAll(".cell:has(> .cell_input, > details > .cell_input)")]
    .filter((one) => !one.closest(".solution") && one.compareDocumentPosition(cell) & 4); // one before cell

/* The figures that run a cell's law, as laws.js knows them. */
export const users = { figures: () => [] };

const keyOf = (name) => `${location.pathname} ${name}`;
const checksum = (text) => [...text].reduce((sum, sign) => (31 * sum + sign.codePointAt()) | 0, 0); // tells editions of a cell apart
const isText = ({ said = [], ran = "", judged = "", mine = [] }) => [said, ran, judged, mine].flat().every((one) => typeof one === "string");
/* What is kept of a cell, where it is what an `Editor` keeps: others may write there. */
const read = (key, kept = memory.getParsed(key)) =>
  typeof kept?.typed === "string" && isText(kept) && { ...kept, mine: [kept.mine ?? []].flat() };
const FULL = "This browser has no room for your lines: copy them before you close the page.";
const messageAfterReload = (said) => said.replace(/: (Figures? [\d., and]+) now runs? yours/, ". Your lines are kept: press Run, and $1 will run them again");
const make = (tag, more) => Object.assign(document.createElement(tag), more);

/* A cell in whose place the reader writes, and its form: buttons, and what was said of the lines. */
class Editor {
  constructor(form, cell, name, called = name.split(".").pop()) {
    const { stop, reset } = form.elements, empty = book(cell).trimEnd();
    const area = make("textarea", { defaultValue: empty, spellcheck: false, wrap: "off", autocomplete: "off", className: "vmc-lines" });
    const status = form.querySelector("[role=status]"), beside = make("div", { className: "vmc-beside" });
    Object.assign(this, { form, cell, area, status, empty, beside, key: keyOf(name), mine: [], brought: new Set() });
    area.setAttribute("autocapitalize", "off");
    area.setAttribute("aria-label", `Your lines: ${called}`);
    cell.querySelector(".cell_input").replaceChildren(area, beside);
    form.hidden = false;
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (!this.asked) this.check();
    });
    stop.addEventListener("click", () => this.asked.abort(Error("Stopped.")));
    reset.addEventListener("click", () => this.reset());
    area.addEventListener("keydown", (event) => onKey(event, form));
    for (const sign of ["pointerdown", "input"]) // of one who is about to write: it may be there when asked
      area.addEventListener(sign, python.start, { once: true });
    area.addEventListener("input", () => (this.follow(), this.keep()));
    this.restore();
    this.follow();
  }

  /* The lines have changed: their room, and whether what was said is of them. */
  follow() {
    const { area, form, status, empty, said, judged } = this;
    area.rows = area.value.split("\n").length + 1;
    form.elements.reset.disabled = area.value === empty;
    status.classList.toggle("vmc-earlier", Boolean(said?.[0]) && area.value !== judged);
  }

  show([message, printed]) {
    this.status.innerHTML = `<p>${inline(message)}</p>${printed ? `<pre>${escape(printed)}</pre>` : ""}`;
    setEquations(this.status);
  }

  /* Keep the lines, those that ran last, what was `said` of those that were `judged`, and the reader's own where
     others stand in their place; but nothing that equals the book's, and of a link nothing that has not run. */
  keep() {
    const { area, empty, key, said, judged, mine } = this, typed = area.value, last = area.ran ?? empty;
    if (this.brought.has(typed) && typed !== last) return;
    this.merge();
    const all = JSON.stringify({ typed, ran: last, said, judged, mine, book: checksum(empty) });
    if (typed === empty && last === empty && !mine.length) memory.remove(key);
    else if (!memory.set(key, all) && !this.status.textContent.includes(FULL))
      this.show([[...(said ?? [""]).slice(0, 1), FULL].join(" "), said?.[1]]);
    this.kept = memory.get(key);
  }

  /* Another tab may have kept other lines since this one looked: they stay the reader's. */
  merge() {
    const { key, kept } = this;
    if (memory.get(key) === kept) return;
    const there = read(key);
    if (there && [there.typed, ...there.mine].filter((lines) => this.retain(lines)).length) this.close();
  }

  /* Lines of the reader's stay beside the cell when others take their place. */
  retain(lines) {
    const { area, empty, brought, mine } = this;
    return ![area.value, empty, ...brought, ...mine].includes(lines) && mine.push(lines);
  }

  drop(lines) {
    if (this.mine.includes(lines)) this.mine.splice(this.mine.indexOf(lines), 1);
  }

  restore() {
    const { area, empty, key } = this, kept = read(key);
    this.kept = memory.get(key);
    if (!kept) return;
    area.value = kept.typed;
    this.mine = kept.mine;
    Object.assign(this, { said: kept.said, judged: kept.judged });
    if (kept.said?.length) this.show([messageAfterReload(kept.said[0]), kept.said[1]]);
    if ((kept.book ?? checksum(empty)) === checksum(empty)) area.ran = kept.ran;
    else return this.offer("The book’s cell has changed since you wrote yours. It is now:", empty);
    this.close();
  }

  /* Lines that stand beside the reader's, who may take them; by `no` they go. */
  choice(words, lines, yes, no, go) {
    const button = (textContent, onclick) => make("button", { type: "button", textContent, onclick });
    const leave = () => (go(), this.close(), this.keep(), this.area.focus());
    return [make("p", { textContent: words }), make("pre", { textContent: lines, tabIndex: 0 }), button(yes, () => this.take(lines)), " ", button(no, leave)];
  }

  offer(words, lines) {
    this.beside.replaceChildren(...this.choice(words, lines, "Take it", "Keep mine", () => {}));
  }

  /* Nothing is offered any more but the reader's own lines, where others stand in their place. */
  close() {
    const ownChoice = (lines) => this.choice("Your own lines:", lines, "Take them back", "Forget them", () => this.drop(lines));
    this.beside.replaceChildren(...this.mine.flatMap(ownChoice));
  }

  bring(text) {
    const lines = text.replace(/\r\n?/g, "\n"); // as a field has them
    this.brought.add(lines);
    if (lines !== this.area.value) this.offer("A link brings these lines:", lines);
  }

  /* What is being checked ends unanswered: other lines take its place. */
  end() {
    if (!this.asked) return;
    this.asked.abort();
    this.asked = null;
    this.show([""]);
    disable(this.form.elements.stop);
  }

  take(lines) {
    const { area } = this, before = area.value;
    this.end();
    this.drop(lines);
    area.select();
    type(area, lines);
    this.retain(before);
    this.close();
    this.keep();
  }

  run(lines) { // the demos below may follow: see laws.js
    this.area.ran = this.area.lastRun = lines;
    this.brought.delete(lines); // the reader's own, from now on
    this.keep();
    this.cell.dispatchEvent(new Event("vmc-run", { bubbles: true }));
  }

  /* The figures go back to the book's lines; the reader's stay in the field. */
  goBack() {
    this.end();
    this.said = this.judged = undefined;
    this.run(this.empty);
    this.show(["The figures run the book’s lines again; yours count when you run them."]);
    this.follow();
  }

  async check() {
    const { form, cell, area } = this, { stop } = form.elements, graded = form.dataset.function, lines = area.value;
    const asked = (this.asked = new AbortController());
    this.said = undefined;
    stop.disabled = false;
    this.follow();
    try {
      const code = [cellsAbove(cell).map(keptRun), lines];
      const question = graded ? ["check", ...code, graded] : ["run", ...code, this.empty, users.figures(cell, lines)];
      const [said, printed] = await python.ask(["grader", ...question], (text) => this.show([text]), asked.signal);
      this.said = [`${said}`, `${printed}`];
      this.run(lines);
      form.dispatchEvent(new CustomEvent("vmc-graded", { bubbles: true, detail: { said: this.said[0], lines } }));
    } catch (error) {
      if (this.asked !== asked) return;
      this.said = [`✗ ${error.message}`];
    }
    this.asked = null;
    disable(stop);
    this.judged = lines;
    this.show(this.said);
    this.follow();
    this.keep();
  }

  reset() {
    this.end();
    this.area.select();
    type(this.area, this.empty);
    this.said = this.judged = undefined;
    this.show([""]);
    this.follow();
    this.run(this.empty);
  }
}

/* A cell's *Edit*: it opens the cell, which is open at once where the reader has changed it before. A link may
   bring lines, the reader `take` them, and `goBack` to the book's. */
const offer = (cell) => {
  const names = [...book(cell).matchAll(/^def (\w+)/gm)].map(([, one]) => one), [name] = names, called = names.join(", ");
  const form = make("form", { className: "vmc-check" });
  form.dataset.cell = name;
  form.innerHTML = `<button type="button" aria-label="Edit ${called}">Edit</button>`;
  cell.append(form);
  let editor;
  const open = () => {
    if (cell.querySelector("details")) cell.querySelector("details").open = true; // its code is folded
    form.innerHTML = '<button>Run</button> <button type="button" name="stop" disabled>Stop</button> ' +
      '<button type="button" name="reset" disabled>Reset</button> <div role="status"></div>';
    return (editor = new Editor(form, cell, name, called));
  };
  cell.addEventListener("vmc-bring", ({ detail }) => (editor ?? open()).bring(detail));
  cell.addEventListener("vmc-take", ({ detail }) => editor.take(detail));
  cell.addEventListener("vmc-back", () => editor.goBack());
  form.firstChild.addEventListener("click", () => {
    open();
    cell.querySelector("textarea").focus();
  });
  if (memory.get(keyOf(name))) open();
};

addEventListener("DOMContentLoaded", () => {
  for (const form of document.querySelectorAll("form[data-function]"))
    new Editor(form, form.closest(".cell").previousElementSibling, form.dataset.function);
  document.querySelectorAll(".cell.tag_runs-in-page").forEach(offer);
});
