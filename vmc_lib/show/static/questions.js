/* Checks what the reader types into a page that has no kernel (vmc_lib.show.check). */
addEventListener("submit", (event) => {
  const form = event.target;
  if (!form.matches("form.vmc-check")) return;
  event.preventDefault();
  const { expected, tolerance } = JSON.parse(form.dataset.check);
  const typed = form.querySelector("input").value.replace("−", "-").split(/[\s,;]+/).filter(Boolean);
  const agrees = (text, wanted) =>
    typeof wanted === "number"
      ? Math.abs(Number(text) - wanted) <= tolerance
      : text.toLowerCase() === wanted.toLowerCase();
  const right = typed.length === expected.length && typed.every((t, i) => agrees(t, expected[i]));
  const verdict = typed.length ? (right ? "right" : "wrong") : "empty";
  form.querySelector("[role=status]").innerHTML = JSON.parse(form.dataset.words)[verdict];
  window.MathJax?.typesetPromise?.([form]);
});
