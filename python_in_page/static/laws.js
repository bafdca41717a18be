/* Demos that the page's Python draws: by a law that the reader has changed above them, and between a
   slider's stops. Where it cannot, or is not asked, the nearest picture of the book stands. And arms
   that plan by such a law. */
const vmcLaws = (() => {
  "use strict";

  const STEP = 0.1; // of a slider, from one stop to the next
  const FREE = "The sliders now take any value.";
  const LAW = "law."; // before a cell's name, in an address

  const ran = (cell) => cell.querySelector("textarea")?.ran ?? vmcGrade.book(cell);
  const code = (names) => names.map((name) => `<code>${name}</code>`).join(", ");
  const edited = (above) => above.filter((one) => ran(one) !== vmcGrade.book(one));
  const BACK = '<button type="button" name="back" hidden>Back to the book’s</button>';

  /* A line below controls: what it says, and its buttons. */
  const line = (controls, buttons) => {
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
      for (const one of edited(above)) one.querySelector("textarea").ran = undefined;
      document.querySelectorAll(".tag_runs-in-page").forEach((one) => one.dispatchEvent(new Event("vmc-run", { bubbles: true })));
    });
  };

  /* Where a demo's controls stand, by name: see `python_in_page.demos.draw`. */
  const places = (demo) => {
    const found = {};
    for (const { type, checked, name, id, value } of demo.querySelectorAll("[data-stride]"))
      if (type !== "radio" || checked)
        found[(name || id).slice(demo.id.length + 1)] = type === "checkbox" ? +checked : +value;
    return found;
  };

  const follow = (demo) => {
    const cell = demo.closest(".cell"), above = vmcGrade.above(cell);
    const [status, run, back, between] = line(demo.querySelector(".vmc-controls"),
      `<button type="button" name="run" hidden>Run it</button> ${BACK} ` +
      '<button type="button" name="between">Any value (loads Python, 19 MB)</button>');
    const sliders = [...demo.querySelectorAll("[data-between]")];
    between.hidden = !sliders.length;

    const say = (html) => {
      if (status.innerHTML !== html) status.innerHTML = html;
    };
    const given = () => [above.map(ran), above.map(vmcGrade.book), vmcGrade.book(cell)];

    let laws = [], failed = false, wanted = null, busy = false, book;

    const show = ({ parts, texts, error }, place, draw) => {
      if (error) return fail(`${laws.length ? `Your \`${laws.join(", ")}\`` : "Python"} stops: ${error}.`, place, draw);
      draw(parts);
      for (const [name, text] of Object.entries(texts)) {
        const input = demo.querySelector(`[id="${demo.id}-${name}"]`);
        input.setAttribute("aria-valuetext", text);
        input.nextElementSibling.textContent = text;
      }
      const free = sliders.length && between.hidden ? FREE : "";
      say(laws.length ? `This demo runs <strong>your</strong> ${code(laws)}.` : free);
    };
    const fail = (why, place, draw) => {
      failed = true;
      book(place, draw);
      say(`${vmcGrade.inline(why)} This is the book’s.`);
    };

    /* The last place that was asked for; those that the hand only passes are left out. */
    const drawn = async () => {
      busy = true;
      demo.setAttribute("aria-busy", "true");
      while (wanted) {
        const [place, draw, ready] = wanted;
        wanted = null;
        try {
          const found = await vmcPython.ask(["demos", "draw", ...given(), demo.id, ready ? null : places(demo), demo.vmc.data ?? ""], say);
          if (!wanted) show(found, place, draw);
        } catch (error) {
          fail(error.message, place, draw);
        }
      }
      busy = false;
      demo.removeAttribute("aria-busy");
    };

    const ask = (place, draw, exact, ready = false) => {
      const off = sliders.some(({ value }) => value % 1);
      if (!laws.length || failed) book(place, draw, exact);
      if (failed || !(laws.length || off || ready)) return;
      wanted = [place, draw, ready];
      if (!busy) drawn();
    };

    const take = () => {
      if (demo.vmc.ask !== ask) [book, demo.vmc.ask] = [demo.vmc.ask, ask];
    };

    /* What the reader's cells have become. */
    const update = async () => {
      take();
      [laws, failed, wanted] = [[], false, null];
      run.hidden = true;
      say("");
      try {
        if (edited(above).length) laws = await vmcPython.ask(["grader", "changed", ...given()], () => {});
      } catch (error) {
        say(vmcGrade.inline(error.message));
      }
      back.hidden = !laws.length;
      demo.vmc.show();
    };

    const named = (one) => one.querySelector("form[data-cell]")?.dataset.cell; // an exercise has none
    demo.vmcLaws = () => edited(above).filter(named).map((one) => [LAW + named(one), ran(one)]);
    watch(above, back, update);
    between.addEventListener("click", () => demos.forEach((one) => one.vmcBetween(one === demo)));
    demo.vmcBetween = (ready) => {
      take();
      sliders.forEach((input) => (input.step = STEP));
      between.hidden = true;
      ready ? demo.vmc.ask(0, () => {}, {}, true) : say(FREE);
    };
    demo.vmcBring = (cells) => {
      say(`This link brings another ${code(cells.map(({ dataset }) => dataset.cell))}. Read it in its cell first.`);
      run.hidden = false;
      run.onclick = () => cells.forEach((form) => form.requestSubmit());
    };
  };

  /* An arm whose physics runs in the page (arm_in_page): it plans by the weights of the reader's law. */
  const lead = (box) => {
    const { law } = box.dataset, above = vmcGrade.above(box.closest(".cell")), form = box.querySelector("form");
    const [status, back] = line(form, BACK);
    const say = (html) => (status.innerHTML = html);
    let mine = false;
    watch(above, back, async () => {
      try {
        const asked = ["grader", "changed", above.map(ran), above.map(vmcGrade.book), law];
        mine = edited(above).length > 0 && (await vmcPython.ask(asked, () => {})).length > 0;
        say(mine ? `This arm plans by <strong>your</strong> ${code([law])}: let it reach.` : "");
      } catch (error) {
        mine = false;
        say(vmcGrade.inline(error.message));
      }
      back.hidden = !mine;
      form.querySelector("fieldset").dispatchEvent(new Event("input", { bubbles: true })); // it plans anew
    });
    box.vmcLaw = async ({ target, points }) => {
      if (!mine) return null;
      const asked = ["grader", "call", above.map(ran), law, [target, points]];
      const { answer, error } = await vmcPython.ask(asked, () => {}).catch(({ message }) => ({ error: message }));
      if (answer?.length === points.length) return answer;
      say(vmcGrade.inline(`Your \`${law}\` ${error ? `stops: ${error}` : `gives no ${points.length} weights`}. This is the book’s.`));
      return null;
    };
  };

  /* The laws that an address brings are put into their cells, and run when the reader asks for it. */
  const bring = () => {
    const [id, query] = location.hash.slice(1).split("?");
    const laws = [...new URLSearchParams(query)].filter(([key]) => key.startsWith(LAW));
    const found = [...document.querySelectorAll("form[data-cell]")];
    const forms = laws.map(([key, text]) => {
      const form = found.find(({ dataset }) => dataset.cell === key.slice(LAW.length));
      form?.closest(".cell").dispatchEvent(new CustomEvent("vmc-bring", { detail: text }));
      return form;
    });
    if (forms.length) document.getElementById(id)?.vmcBring?.(forms.filter(Boolean));
  };

  let demos = [];
  addEventListener("DOMContentLoaded", () => {
    demos = [...document.querySelectorAll(".tag_draws-in-page .vmc-demo:has(> script)")];
    demos.forEach(follow);
    document.querySelectorAll(".vmc-live[data-law]").forEach(lead);
    bring();
  });
  addEventListener("hashchange", bring);
})();
