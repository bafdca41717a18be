/* The ledger's numbers, measured again in the page: draw after draw, from a seed of the reader's on, and
   what they are on average stands beside what ships. */
import { disable } from "./disable.js";
import { inline } from "./grade.js";
import * as python from "./interpreter.js";

const DRAWS = 6; // as many as most numbers of the ledger have

const addMeasure = (form) => {
  const { where, shipped } = form.dataset, ours = JSON.parse(shipped);
  form.innerHTML = `<label>Measure it again, here, from seed <input type="number" name="seed" value="100" min="0" max="999999" required></label>
    <button>Measure</button> <button type="button" name="stop" disabled>Stop</button> <span role="status"></span>
    <div class="vmc-data" tabindex="0" role="group" aria-label="Measured again" hidden></div>`;
  const { seed, stop } = form.elements;
  let asked;
  const status = form.querySelector("[role=status]"), table = form.querySelector(".vmc-data");
  const say = (words) => (status.textContent = words);
  const show = (found) => {
    const rows = Object.entries(found).map(([name, text]) => [name, ours[name], text]);
    const cells = (tag, row) => `<tr>${row.map((text) => `<${tag}>${inline(text)}</${tag}>`).join("")}</tr>`;
    table.innerHTML = `<table>${cells("th", ["number", "as it ships (95 %)", "measured here (95 %)"])}` +
      `${rows.map((row) => cells("td", row)).join("")}</table>`;
    table.hidden = false;
  };
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    if (!stop.disabled) return;
    stop.disabled = false;
    asked = new AbortController();
    const first = +seed.value, draws = [], { signal } = asked;
    try {
      while (draws.length < DRAWS) {
        const next = `Draw ${draws.length + 1} of ${DRAWS}`;
        draws.push(await python.ask(["measure", "draw", where, first + draws.length], (words) => say(`${next}. ${words}`), signal));
        show(await python.ask(["measure", "summary", draws], () => {}, signal));
      }
      say(`Seeds ${first} to ${first + DRAWS - 1}.`);
    } catch (error) {
      say(`✗ ${error.message}`);
    }
    disable(stop);
  });
  stop.addEventListener("click", () => asked.abort(Error("Stopped.")));
  form.hidden = false;
};

addEventListener("DOMContentLoaded", () => document.querySelectorAll(".vmc-measure").forEach(addMeasure));
