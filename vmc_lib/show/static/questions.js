/* What a reader chose is remembered where the browser remembers: it may be told not to. */
const vmcMemory = {
  get: (key) => { try { return localStorage.getItem(key); } catch { return null; } },
  set: (key, text) => { try { localStorage.setItem(key, text); } catch {} },
};

/* A prediction is there again when the page is. */
{
  const key = (input) => `${location.pathname} ${input.name}`;
  const inputs = ".vmc-predict input";
  addEventListener("DOMContentLoaded", () =>
    document.querySelectorAll(inputs).forEach((input) => {
      if (vmcMemory.get(key(input)) === input.value) input.checked = true;
    }));
  addEventListener("change", ({ target }) => {
    if (target.matches(inputs)) vmcMemory.set(key(target), target.value);
  });
}

/* What stands still below a prediction, and would give it away, waits until the reader has chosen or
   asked what came out. */
addEventListener("DOMContentLoaded", () =>
  document.querySelectorAll(".cell .vmc-predict").forEach((question) => {
    let cell = question.closest(".cell").nextElementSibling;
    while (cell?.matches(".cell:not(:has(> .cell_output))")) cell = cell.nextElementSibling;
    if (!cell?.matches(".cell") || cell.querySelector(".vmc-controls, fieldset, input, button.vmc-play")) return;
    const output = cell.querySelector(".cell_output");
    const wait = () => output.classList.toggle("vmc-waits", !question.querySelector(":checked, [open]"));
    for (const type of ["change", "toggle"]) question.addEventListener(type, wait, true);
    wait();
  }));

/* Checks what the reader types into a page that has no kernel (vmc_lib.show.check, by its rule). */
const vmcReadings = (text) => {
  const number = /^([-+]?\d*[.,]?\d+)\s*(?:\/\s*(\d*[.,]?\d+))?\s*(%|\p{L}*|°)$/u;
  const match = text.trim().replace("−", "-").match(number);
  if (!match) return [];
  const [over, under] = [match[1], match[2] ?? "1"].map((part) => Number(part.replace(",", ".")));
  return match[3] === "%" ? [over / under, over / under / 100] : [over / under];
};

addEventListener("submit", (event) => {
  const form = event.target;
  if (!form.matches("form[data-check]")) return;
  event.preventDefault();
  const { expected, tolerance } = JSON.parse(form.dataset.check);
  const text = form.querySelector("input").value.trim();
  const several = (gap) => text.split(gap).filter((part) => /\d/.test(part));
  const apart = several(/,?\s+|;/); // "190, 95" and "0,5 0,8"; else a comma parts
  const typed =
    expected.length === 1 ? [text] : apart.length === expected.length ? apart : several(/[\s;,]+/);
  const agrees = (part, wanted) =>
    typeof wanted === "number"
      ? vmcReadings(part).some((value) => Math.abs(value - wanted) <= tolerance)
      : part.replace(/^["'“”‘’]+|["'“”‘’]+$/g, "").toLowerCase() === wanted.toLowerCase();
  const right = typed.length === expected.length && typed.every((t, i) => agrees(t, expected[i]));
  const verdict = text ? (right ? "right" : "wrong") : "empty";
  form.querySelector("[role=status]").innerHTML = JSON.parse(form.dataset.words)[verdict];
  window.MathJax?.typesetPromise?.([form]);
});
