/* Exercises in which the reader writes a function: the empty one becomes a field to write in, and the
   page's Python grades it. So does a mechanism's cell, where it can run in the page, by its *Edit*: its
   lines run. What was typed, and what was said of it, is there again when the page is. */
const vmcGrade = (() => {
  "use strict";

  const escaped = (text) => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt()};`);
  const MARKS = /`([^`]+)`|\$([^$]+)\$|\*\*([^*]+)\*\*|\*([^*]+)\*/g;

  /* A line of Markdown as HTML, as vmc_lib.show.figures.inline has it. */
  const inline = (text) =>
    escaped(text).replace(MARKS, (_, code, tex, strong, words) =>
      code ? `<code>${code}</code>` : tex ? `<span class="math inline">\\(${tex.trim()}\\)</span>`
        : strong ? `<strong>${strong}</strong>` : `<em>${words}</em>`);

  const field = (cell) => cell.querySelector("textarea");
  const book = (cell) => field(cell)?.defaultValue ?? cell.querySelector("pre").textContent;
  const lines = (cell) => field(cell)?.value ?? book(cell);

  /* The cells of the chapter's code before one of them; no solution is among them. */
  const above = (cell) =>
    [...document.querySelectorAll(".cell:has(> .cell_input, > details > .cell_input)")]
      .filter((one) => !one.closest(".solution") && one.compareDocumentPosition(cell) & 4); // one before cell

  /* Type for the reader, so that it can be undone. */
  const type = (area, text) => {
    area.focus();
    if (!document.execCommand("insertText", false, text)) area.setRangeText(text, area.selectionStart, area.selectionEnd, "end");
  };

  /* Enter indents the next line as Python needs it; Control and Enter check. Tab goes on, as always. */
  const onKey = (event, form) => {
    const area = event.target;
    const before = area.value.slice(0, area.selectionStart).split("\n").pop();
    if (event.key !== "Enter" || event.isComposing) return;
    event.preventDefault();
    if (event.ctrlKey || event.metaKey) form.requestSubmit();
    else type(area, `\n${before.match(/^ */)[0]}${/:\s*(#.*)?$/.test(before) ? "    " : ""}`);
  };

  const memoryOf = (name) => `${location.pathname} ${name}`;

  /* A cell in whose place the reader writes, and its form: buttons, and what was said of the lines. */
  class Editor {
    constructor(form, cell, name) {
      const { stop, reset } = form.elements, area = document.createElement("textarea");
      const status = form.querySelector("[role=status]"), empty = lines(cell).trimEnd();
      Object.assign(this, { form, cell, area, status, empty, memory: memoryOf(name) });
      Object.assign(area, { defaultValue: empty, spellcheck: false, wrap: "off", autocomplete: "off", className: "vmc-lines" });
      area.setAttribute("autocapitalize", "off");
      area.setAttribute("aria-label", `Your lines: ${name.split(".").pop()}`);
      cell.querySelector(".cell_input").replaceChildren(area);
      form.hidden = false;
      form.addEventListener("submit", (event) => {
        event.preventDefault();
        if (stop.disabled) this.check();
      });
      stop.addEventListener("click", () => vmcPython.stop());
      reset.addEventListener("click", () => this.reset());
      area.addEventListener("keydown", (event) => onKey(event, form));
      for (const sign of ["pointerdown", "input"]) // of one who is about to write: it may be there when asked
        area.addEventListener(sign, vmcPython.start, { once: true });
      area.addEventListener("input", () => {
        this.fit();
        this.keep();
      });
      this.restore();
      this.fit();
    }

    fit() {
      this.area.rows = this.area.value.split("\n").length + 1;
      this.form.elements.reset.disabled = this.area.value === this.empty;
    }

    show([message, printed]) {
      this.status.innerHTML = `<p>${inline(message)}</p>${printed ? `<pre>${escaped(printed)}</pre>` : ""}`;
      window.vmcEquations?.(this.status);
    }

    /* `verdict` is of what is typed, or of what was typed before. */
    keep() {
      vmcMemory.set(this.memory, JSON.stringify({ typed: this.area.value, said: this.verdict }));
    }

    restore() {
      const kept = vmcMemory.parsed(this.memory);
      if (kept?.typed === undefined) return;
      this.area.value = kept.typed;
      if (kept.said) this.show((this.verdict = kept.said));
    }

    run() { // the demos below may follow: see laws.js
      this.area.lastRun = this.area.value;
      this.cell.dispatchEvent(new Event("vmc-run", { bubbles: true }));
    }

    async check() {
      const { form, cell, area } = this, { stop } = form.elements, graded = form.dataset.function;
      stop.disabled = false;
      try {
        const code = [above(cell).map(lines), area.value];
        const question = graded ? ["check", ...code, graded] : ["run", ...code, this.empty, window.vmcFigures?.(cell, area.value) ?? []];
        this.verdict = await vmcPython.ask(["grader", ...question], (text) => this.show([text]));
        this.run();
      } catch (error) {
        this.verdict = [`✗ ${error.message}`];
      }
      stop.disabled = true;
      form.dispatchEvent(new CustomEvent("vmc-graded", { bubbles: true, detail: this.verdict[0] }));
      this.show(this.verdict);
      this.keep();
    }

    reset() {
      this.area.select();
      type(this.area, this.empty);
      this.show((this.verdict = [""]));
      this.keep();
      this.run();
    }
  }

  /* A cell's *Edit*: it opens the cell, which is open at once where the reader has changed it before. */
  const offer = (cell) => {
    const name = lines(cell).match(/^def (\w+)/m)[1];
    const form = document.createElement("form");
    form.className = "vmc-check";
    form.dataset.cell = name;
    form.innerHTML = `<button type="button" aria-label="Edit ${name}">Edit</button>`;
    cell.append(form);
    const open = () => {
      if (cell.querySelector("details")) cell.querySelector("details").open = true; // its code is folded
      form.innerHTML = '<button>Run</button> <button type="button" name="stop" disabled>Stop</button> ' +
        '<button type="button" name="reset" disabled>Reset</button> <div role="status"></div>';
      new Editor(form, cell, name);
    };
    cell.addEventListener("vmc-bring", ({ detail }) => {
      if (!field(cell)) open();
      field(cell).select();
      type(field(cell), detail);
    });
    form.firstChild.addEventListener("click", () => {
      open();
      cell.querySelector("textarea").focus();
    });
    if (vmcMemory.get(memoryOf(name))) open();
  };

  addEventListener("DOMContentLoaded", () => {
    for (const form of document.querySelectorAll("form[data-function]"))
      new Editor(form, form.closest(".cell").previousElementSibling, form.dataset.function);
    document.querySelectorAll(".cell.tag_runs-in-page").forEach(offer);
  });
  return { inline, above, book };
})();
