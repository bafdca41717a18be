/* What a reader answered, attempt by attempt: kept in this browser alone, shown at a chapter's end, and
   saved as a file by whoever wants to hand it in. */
import { memory } from "../demo/questions.js";
import { setEquations } from "./equations.js";

const KEY = "vmcRecord", MOST = 2000, LONGEST = 4000, LARGEST = 1e6; // answers, signs of one, and of all: the browser keeps five million
const ASKED = 200; // signs of a question
const page = location.pathname.split("/").pop().replace(/\.html$/, "");
const TEXTS = ["page", "kind", "id", "question", "answer", "feedback"];
const isAnswer = (one) => TEXTS.every((name) => typeof one?.[name] === "string"); // others may write there
const unkept = []; // answers for which the browser had no room
const storedAnswers = () => [memory.getParsed(KEY) ?? []].flat().filter(isAnswer);
const allAnswers = () => [...storedAnswers(), ...unkept].slice(-MOST);

/* The words of an element, its formulas as they were written. */
const words = (node) => {
  const copy = node.cloneNode(true);
  for (const formula of copy.querySelectorAll(".katex"))
    formula.replaceWith(formula.querySelector("annotation")?.textContent ?? "");
  return copy.textContent.replace(/\s+/g, " ").trim();
};

const shorten = (text) => (text.length > ASKED ? `${text.slice(0, ASKED - 1).trimEnd()}…` : text);
const add = (kind, id, question, answer, right, feedback = "") => {
  const entry = { page, kind, id, question: shorten(question), answer: answer.slice(0, LONGEST), right, feedback };
  const entries = [...allAnswers(), entry].slice(-MOST);
  while (JSON.stringify(entries).length > LARGEST) entries.splice(0, Math.ceil(entries.length / 10));
  if (memory.set(KEY, JSON.stringify(entries))) unkept.length = 0;
  else unkept.push(entry);
  show();
};

/* The exercise that an answer is for, by its id and title. */
const exercise = (form) => {
  let block = form.closest(".cell");
  while (block && !block.matches(".exercise")) block = block.previousElementSibling;
  return block ? [block.id, words(block.querySelector(".admonition-title"))] : ["", ""];
};
const verdict = (kind, form, text, answer) => {
  const right = text.startsWith("✓");
  if (right || text.startsWith("✗")) add(kind, ...exercise(form), answer, right, right ? "" : text.replace(/^✗ (Not yet\.)?\s*/, ""));
};

addEventListener("vmc-predicted", ({ target }) => {
  const question = words(target.closest("fieldset").querySelector("legend"));
  add("prediction", target.name, question, target.value, target.closest("label").matches(".vmc-right"));
});
addEventListener("click", ({ target }) => { // the browser itself opens them, too, for a link or a search
  const answer = target.closest(".vmc-quiz > details:not([open]) > summary");
  if (!answer) return;
  const quiz = answer.closest(".vmc-quiz");
  add("quiz", quiz.name, words(quiz.querySelector("legend")), words(answer), answer.parentElement.matches(".vmc-right"));
});
addEventListener("submit", ({ target }) => { // after questions.js has judged it
  if (target.matches("form[data-check]"))
    verdict("exercise", target, words(target.querySelector("[role=status]")), target.querySelector("input").value.trim());
});
addEventListener("vmc-graded", ({ target, detail: { said, lines } }) => {
  if (!("cell" in target.dataset)) verdict("exercise", target, said, lines); // who runs a mechanism answers nothing
});

const FORGET = "Forget all of it", SURE = "Forget every answer and line, of all chapters?";
const place = document.createElement("details");
place.className = "vmc-record";
place.innerHTML = "<summary></summary><p role=\"status\"></p><p>If you save it as a file, the file holds these lines, the name that you " +
  "write here, and nothing else. Who forgets it all empties every page's fields, too: on a computer that others use, do.</p><p class=\"vmc-check\"><label>Name or number, if your course asks for one: <input size=\"12\" autocomplete=\"off\"></label></p>" +
  "<p class=\"vmc-check\"><button type=\"button\">Save as a file</button> <button type=\"button\">" + FORGET + "</button></p><ol></ol>";
const [save, forget] = place.querySelectorAll("button");
const STAYS = "It stays in this browser.", GOES = "This browser keeps no more: save your answers as a file before you close the page.";

const show = () => {
  const { length } = storedAnswers();
  place.hidden = !length && !unkept.length;
  place.querySelector("summary").textContent = `What this browser has kept of your answers: ${length}`;
  const goes = unkept.length > 0 || document.documentElement.dataset.storage === "page";
  if (goes) place.open = true;
  place.querySelector("[role=status]").textContent = goes ? GOES : STAYS;
  drawList();
};

/* Many answers, with their formulas, take seconds to draw: who looks at them waits. */
const drawList = () => {
  if (!place.open) return;
  const items = place.querySelector("ol");
  items.replaceChildren(...allAnswers().map(({ page, kind, question, answer, right, feedback }) => {
    const code = /\n|^\s/.test(answer), item = document.createElement("li"); // whatever else is typed was trimmed
    const make = (tag, textContent) => Object.assign(document.createElement(tag), { textContent });
    const text = (words) => words.replace(/\$([^$]+)\$/g, "\\($1\\)"), ends = text(` ${right ? "✓" : "✗"} ${feedback}`);
    item.append(text(`${page}, ${kind}: ${question}`), ...(code ? [ends, make("pre", answer)] : [" → ", make("strong", text(answer)), ends]));
    return item;
  }));
  setEquations(items);
};
place.addEventListener("toggle", drawList);
save.addEventListener("click", () => {
  const who = place.querySelector("input").value.trim();
  const url = URL.createObjectURL(new Blob([JSON.stringify({ format: "answers 1", who, answers: allAnswers() }, null, 1)], { type: "application/json" }));
  Object.assign(document.createElement("a"), { href: url, download: `answers-${who.replace(/[^\w-]+/g, "_") || "mine"}.json` }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
});
/* At the second click, all that any page of the book has kept, and what stands in this one's fields. */
forget.addEventListener("click", () => {
  if (forget.textContent !== SURE) return (forget.textContent = SURE);
  const book = location.pathname.replace(/[^/]*$/, "");
  memory.keys.filter((key) => key.startsWith("vmc") || key.startsWith(book)).forEach(memory.remove);
  for (const field of document.querySelectorAll("input, textarea"))
    Object.assign(field, { value: field.defaultValue, checked: field.defaultChecked }); // lest the browser brings it back
  location.reload();
});

forget.addEventListener("blur", () => (forget.textContent = FORGET));

addEventListener("storage", ({ key }) => { // another tab kept or forgot some
  if (key === KEY || key === null) show();
});
addEventListener("DOMContentLoaded", () => {
  if (!document.querySelector(".vmc-predict, .vmc-quiz, form[data-check], form[data-function]")) return;
  document.querySelector("article")?.append(place);
  show();
});
