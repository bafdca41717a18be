import { setEquations } from "../book/equations.js";

/* What a reader chose is remembered where the browser remembers: it may be told not to. `set` is false where it is full. */
export const memory = {
  get: (key) => { try { return localStorage.getItem(key); } catch { return null; } },
  getParsed: (key) => { try { return JSON.parse(localStorage.getItem(key)); } catch { return null; } }, // it may be cut
  set: (key, text) => { try { localStorage.setItem(key, text); } catch ({ name }) { return !/quota/i.test(name); } return true; },
  remove: (key) => { try { localStorage.removeItem(key); } catch {} },
  get keys() { try { return Object.keys(localStorage); } catch { return []; } },
};

/* A prediction and what was typed are there again when the page is. */
const inputs = ".vmc-predict input, form[data-check] input", MEANT = " meant";
const questionOf = (target) => target.closest(".vmc-predict label")?.closest(".vmc-predict");
const key = ({ name }) => `${location.pathname} ${name}`;
addEventListener("DOMContentLoaded", () =>
  document.querySelectorAll(inputs).forEach((input) => {
    const kept = memory.get(key(input)), question = questionOf(input);
    if (!question) input.value = kept ?? "";
    else if ((input.checked ||= input.value === kept))
      memory.get(key(input) + MEANT) ? (question.dataset.chosen = true) : (question.passed = input);
  }));
addEventListener("change", ({ target }) => {
  if (!target.matches(inputs)) return;
  memory.set(key(target), target.value);
  const question = questionOf(target);
  if (question) question.passed = target;
  if (question?.clicked) settle(question);
});

/* A choice opens what came out, and counts: by a click or Enter, or where the reader opens it; for arrows pass over
   choices that are not meant. */
const settle = (question) => {
  const { passed } = question;
  if (!passed?.checked) return;
  question.passed = null;
  question.dataset.chosen = true;
  memory.set(key(passed) + MEANT, "yes");
  passed.dispatchEvent(new Event("vmc-predicted", { bubbles: true }));
};
const open = (question) => question.querySelector("details").toggleAttribute("open", true);
addEventListener("click", ({ target, detail }) => {
  const question = detail && questionOf(target);
  if (!question) return;
  open(question);
  question.clicked = true; // then the choice changes, if it does
  if (target.closest("label").contains(question.passed)) settle(question);
});
addEventListener("keydown", ({ target, key }) => { // a question keeps its keys to itself
  const question = questionOf(target);
  if (!question) return;
  question.clicked = false;
  if (key !== "Enter") return;
  target.click(); // Tab comes to the first choice, and arrows alone choose
  open(question);
  settle(question);
}, true);
addEventListener("toggle", ({ target }) => {
  if (target.matches?.(".vmc-predict > details[open]")) settle(target.parentElement);
}, true);

/* What stands still below a prediction, and would give it away, waits until the reader has chosen or
   asked what came out; and so do still figures right below it. */
const MOVED = ".vmc-controls, fieldset, input, button.vmc-play";
addEventListener("DOMContentLoaded", () =>
  document.querySelectorAll(".admonition > .vmc-predict").forEach((question) => {
    const outputs = [];
    for (let cell = question.parentElement; (cell = cell.nextElementSibling)?.matches(".cell"); ) {
      const output = cell.querySelector(":scope > .cell_output");
      if (output?.querySelector(MOVED) || (outputs.length && output && !output.querySelector(".vmc-demo"))) break;
      if (output) outputs.push(output);
    }
    const wait = () => outputs.forEach((output) =>
      output.classList.toggle("vmc-waits", !question.dataset.chosen && !question.querySelector("[open]")));
    for (const type of ["vmc-predicted", "toggle"]) question.addEventListener(type, wait, true);
    wait();
  }));

/* How a typed answer is: vmc_lib.show.answers.judge, by its rules. */
export const judge = (text, { expected, tolerance, scales, rules }) => {
  const clean = rules.clean.reduce((line, [pattern, by]) =>
    line.replace(RegExp(pattern, "g"), by).normalize("NFKC"), text.toLowerCase());
  const splits = expected.length > 1 ? rules.gaps.map((gap) => clean.split(RegExp(gap))) : [[clean]];
  const number = RegExp(`^(?:${rules.number})$`);
  const parts = splits.find((split) => split.length === expected.length)?.map((part) => part.match(number));
  if (!parts?.every(Boolean)) return "unread";
  const singular = (unit) => unit.replace(/[\s·]/g, "").replace(/(?<=[\p{L}\d_]{3})s$/u, "");
  const factors = parts.map(([, , , unit = ""]) => Object.hasOwn(scales, singular(unit)) && scales[singular(unit)]);
  if (!factors.every(Boolean)) return "unit";
  const near = ([, over, under = "1"], k) => {
    const value = (factors[k] * Number(over.replace(",", "."))) / Number(under.replace(",", "."));
    return Math.abs(value - expected[k]) <= tolerance + 1e-9 * Math.abs(expected[k]);
  };
  return parts.every(near) ? "right" : "wrong";
};

/* Checks what the reader types into a page that has no kernel (vmc_lib.show.check). */
addEventListener("submit", (event) => {
  const form = event.target;
  if (!form.matches("form[data-check]")) return;
  event.preventDefault();
  const question = JSON.parse(form.dataset.check);
  const text = form.querySelector("input").value.trim();
  const word = text.replace(/^["'“”‘’\s]+|["'“”‘’\s.]+$/g, "").toLowerCase();
  const verdict = !text ? "empty" : question.rules ? judge(text, question) : word === question.expected ? "right" : "wrong";
  form.querySelector("[role=status]").innerHTML = JSON.parse(form.dataset.words)[verdict];
  setEquations(form);
});
