/* What page tests ask a page: each function returns what is wrong, and an empty list if nothing is. */

const demos = () => [...document.querySelectorAll(".vmc-demo[data-ready]")];
const fire = (target) => target.dispatchEvent(new Event("input", { bubbles: true }));

/* Controls that never move their picture: each goes through its values, if need be with the other
   controls elsewhere, until the picture differs. */
async function idleControls() {
  const look = (demo) => [...demo.querySelectorAll(".vmc-picture")].map((picture) => {
    const scene = picture.querySelector(".vmc-scene");
    return scene ? vmc["demo/scene"].viewOf(scene).viewer.capture_image() : picture.innerHTML;
  }).join();
  const controls = (demo) => {
    const groups = Map.groupBy(demo.querySelectorAll("[data-stride]"), (i) => i.name || i.id || i);
    return [...groups.values()].map((inputs) => {
      const [input] = inputs;
      const set = {
        range: (v) => { input.value = v; fire(input); },
        checkbox: (v) => { input.checked = v; fire(input); },
        radio: (v) => { inputs[v].checked = true; fire(inputs[v]); },
        "select-one": (v) => { input.selectedIndex = v; fire(input); },
      }[input.type];
      const count = { range: +input.max + 1, checkbox: 2, radio: inputs.length }[input.type]
        ?? input.options?.length;
      return { name: input.id || input.closest(".vmc-control").textContent, set, count };
    });
  };
  const moves = (demo, { set, count }) => {
    set(0);
    const first = look(demo);
    for (let v = count - 1; v > 0; v--) { set(v); if (look(demo) !== first) return true; }
    return false;
  };
  const idle = [];
  for (const demo of demos()) {
    for (const div of demo.querySelectorAll(".vmc-scene")) await vmc["demo/scene"].viewOf(div).wake();
    const all = controls(demo);
    for (const control of all) {
      const others = all.filter((other) => other !== control);
      const settings = others.flatMap((o) => [...Array(o.count).keys()].map((v) => [o, v]));
      if (!moves(demo, control) && !settings.some(([o, v]) => (o.set(v), moves(demo, control))))
        idle.push(`${demo.id} ${control.name}`);
    }
  }
  return idle;
}

/* Text outside code, with TeX that was not typeset. */
function rawTex() {
  const walker = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  const wrong = document.querySelectorAll(".katex-error");
  const raw = [...wrong].map((e) => e.outerHTML);
  const tex = /\\\(|\\\[|\$\$|\\(frac|sum|begin|mathbf|boldsymbol)|\$[^$\s][^$]*\$/;
  while (walker.nextNode()) {
    const { data, parentElement } = walker.currentNode;
    if (parentElement.closest("pre, code, script, style, annotation")) continue;
    if (tex.test(data)) raw.push(data);
  }
  return raw;
}

/* Prose that names an equation without a link to it. */
function unlinkedEquations() {
  return [...document.querySelectorAll("article p, article li, article figcaption")]
    .map((prose) => prose.cloneNode(true))
    .filter((prose) => {
      prose.querySelectorAll("a, code, label").forEach((part) => part.remove());
      return /\bEqs?\. \d/.test(prose.textContent);
    }).map((prose) => prose.textContent);
}

/* Pictures that hold what is no number, at any place of a slider that can be dragged. */
function brokenDrags() {
  return demos().flatMap((demo) => [...demo.querySelectorAll(".vmc-pad input")])
    .flatMap((slider) => [...Array(25).keys()].map((part) => {
      slider.value = Math.round(part / 24 * slider.max);
      fire(slider);
      const drawn = slider.closest(".vmc-demo").querySelector(".vmc-pictures").outerHTML;
      return drawn.replace(/data:[^"]*/g, ""); // a photograph's letters may spell anything
    })).filter((markup) => /NaN|undefined|Infinity/.test(markup));
}

/* Demos whose sliders begin at different places, or move when others do. */
function restlessSliders() {
  return demos().filter((demo) => {
    const sliders = [...demo.querySelectorAll("input[data-texts]:not(.vmc-more *)")];
    const ends = () => sliders.map((slider) => slider.getBoundingClientRect())
      .map(({ left, right }) => `${left} ${right}`);
    const before = ends();
    for (const slider of sliders) slider.value = slider.max;
    fire(demo);
    return new Set([...before, ...ends()]).size > 1;
  }).map((demo) => demo.id);
}

/* Sliders that, dragged to some places (parts of their way), move a control of their demo in the window;
   a demo whose states are not in the page draws a little later. */
async function jumpySliders(places) {
  const seen = (one) => one.checkVisibility({ visibilityProperty: true });
  const jumps = async (slider) => {
    const demo = slider.closest(".vmc-demo"), min = +slider.min, range = slider.max - min;
    const controls = [...demo.querySelectorAll("input, select, button")].filter(seen);
    const edges = () => controls.map((one) => one.getBoundingClientRect())
      .flatMap(({ left, right, top }) => [left, right, top]);
    slider.scrollIntoView({ block: "center", behavior: "instant" });
    slider.focus({ preventScroll: true });
    const start = slider.value, before = edges();
    let farthest = 0;
    slider.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true }));
    for (const part of places) {
      slider.value = min + part * range;
      fire(slider);
      for (let frames = demo.vmc ? 0 : 2; frames--; ) await new Promise(requestAnimationFrame);
      farthest = Math.max(farthest, ...edges().map((edge, i) => Math.abs(edge - before[i])));
    }
    slider.value = start;
    fire(slider);
    return farthest > 1;
  };
  const all = document.querySelectorAll(".vmc-demo"), jumpy = [];
  for (const demo of all) demo.scrollIntoView({ block: "center", behavior: "instant" }); // and what is there loads
  const tops = () => `${[...all].map((demo) => demo.getBoundingClientRect().top)}`;
  for (let still = 0, before; still < 10; still++) {
    await new Promise(requestAnimationFrame);
    const now = tops();
    if (now !== before) still = 0;
    before = now;
  }
  for (const slider of document.querySelectorAll(".vmc-demo input[type=range]:enabled"))
    if (seen(slider) && (await jumps(slider))) jumpy.push(slider.id || slider.closest("label").textContent);
  return jumpy;
}

/* Marks of folded code that are smaller than `least`, or that lie on words or code. */
function crowdedMarks(least) {
  const apart = "summary, script, .katex, .vmc-spoken, [class*=scrollable-table]";
  const shown = { opacityProperty: true, visibilityProperty: true }; // a closed solution is not
  const range = document.createRange();
  const words = document.createTreeWalker(document.querySelector("article"), NodeFilter.SHOW_TEXT);
  const lines = [];
  while (words.nextNode()) {
    const { currentNode: word, currentNode: { parentElement: within } } = words;
    if (within.closest(apart) || !within.checkVisibility(shown) || !word.data.trim()) continue;
    range.selectNodeContents(word);
    lines.push(...range.getClientRects());
  }
  return [...document.querySelectorAll("details.hide > summary")].filter((mark) => {
    const { left, right, top, bottom, width, height } = mark.getBoundingClientRect();
    const lies = (line) => line.width && line.left < right - 1 && line.right > left + 1
      && line.top < bottom - 1 && line.bottom > top + 1;
    return width && (Math.min(width, height) < least || lines.some(lies));
  }).map((mark) => mark.closest(".cell").outerHTML.slice(0, 300));
}

/* Equations that would scroll, and words that leave their picture. */
function cutWords() {
  const equations = [...document.querySelectorAll("div.math")];
  const wide = equations.filter((e) => e.scrollWidth > e.clientWidth + 1);
  const out = [...document.querySelectorAll(".vmc-picture svg text")].filter((word) => {
    const [box, frame] = [word, word.ownerSVGElement].map((e) => e.getBoundingClientRect());
    return box.width && (box.left < frame.left - 3 || box.right > frame.right + 3
      || box.top < frame.top - 3 || box.bottom > frame.bottom + 3);
  });
  return [...wide, ...out].map((e) => e.textContent);
}

/* What is wider than the window, within a part of the page, but for what may scroll. */
function tooWide(within) {
  return [...document.querySelectorAll(`${within} *:not(pre *, table *, svg *)`)]
    .filter((e) => e.getBoundingClientRect().right > innerWidth + 1
      && !e.closest("pre, table, div.math, .katex-mathml, .vmc-spoken, .vmc-picture"))
    .map((e) => e.outerHTML.slice(0, 120));
}

/* Pictures that did not load. */
async function missingPictures() {
  const all = [...document.querySelectorAll("img[src]")];
  all.forEach((picture) => (picture.loading = "eager"));
  await Promise.all(all.map((picture) => picture.decode().catch(() => null)));
  return all.filter((picture) => !picture.complete || !picture.naturalWidth).map(({ src }) => src);
}

/* Demos whose first slider moves no picture, scenes aside; waits until every demo is ready. */
async function idleSliders() {
  const all = [...document.querySelectorAll(".vmc-demo:has(> script)")];
  while (all.some((demo) => !("ready" in demo.dataset))) await new Promise(requestAnimationFrame);
  return all.filter((demo) => {
    const slider = demo.querySelector("input[data-texts]");
    if (!slider || demo.querySelector(".vmc-scene")) return false;
    const pictures = demo.querySelector(".vmc-pictures"), before = pictures.innerHTML;
    return ![...Array(+slider.max + 1).keys()].some((place) => {
      slider.value = place;
      fire(slider);
      return pictures.innerHTML !== before;
    });
  }).map((demo) => demo.id);
}

/* Equations that were not typeset. */
function unsetEquations() {
  return [...document.querySelectorAll(".math")]
    .filter((one) => !one.querySelector(".katex")).map((one) => one.textContent);
}

/* Demos of whose pictures a control covers a part, at any place where they can be scrolled to, every `step` px:
   as the page comes, and while a slider is held at its end. */
function coveredPictures(step) {
  const meet = (one, other) => one.left < other.right - 1 && other.left < one.right - 1
    && one.top < other.bottom - 1 && other.top < one.bottom - 1;
  const covered = (demo) => {
    const [pictures, controls] = [".vmc-picture :is(svg, img, canvas)", ".vmc-controls, button, input, select, summary, output"]
      .map((parts) => [...demo.querySelectorAll(parts)].filter((part) => part.checkVisibility({ visibilityProperty: true })));
    const { top, bottom } = demo.getBoundingClientRect(), from = scrollY + top - innerHeight, to = scrollY + bottom;
    for (let y = Math.max(0, from); y < to; y += step) {
      scrollTo({ top: y, behavior: "instant" });
      const [these, those] = [pictures, controls].map((parts) => parts.map((part) => part.getBoundingClientRect()));
      if (these.some((picture) => those.some((control) => meet(picture, control)))) return true;
    }
  };
  const coveredWhileHeld = (demo) => {
    const slider = demo.querySelector("input[type=range]:enabled");
    if (!slider) return false;
    const { value } = slider;
    slider.focus({ preventScroll: true });
    slider.value = slider.max;
    fire(slider);
    const found = covered(demo);
    slider.value = value;
    fire(slider);
    slider.blur();
    return found;
  };
  return [...document.querySelectorAll(".vmc-demo")]
    .filter((demo) => covered(demo) || coveredWhileHeld(demo)).map(({ id }) => id);
}
