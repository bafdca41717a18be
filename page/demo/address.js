import { moveTo } from "./control.js";

/* What stands after the # of the page's address, even if it came encoded, or cut. */
export const hash = () => {
  const text = location.hash.slice(1).replaceAll("&amp;", "&"); // as some mail programs write it
  if (/\?.*=/.test(text)) return text; // as it was written: who reads its values decodes them
  try { return decodeURIComponent(text); } catch { return text; } // cut in the middle of a sign
};

/* What the address names, and where a demo's controls stand: [id, query]. Demos had numbers before they
   had names: a link of that time names the page's demo of that number. */
export const address = () => {
  const [name, query] = hash().split("?"), [, number] = name.match(/^demo-(\d+)$/) ?? [];
  const numbered = number && document.querySelectorAll(".vmc-demo[id^=demo-]")[number - 1];
  return [numbered?.id ?? name, query];
};

/* Put a sign at a caption's end, where it is never alone on a line: the last word goes along. */
export const addSign = (caption, sign) => {
  let end = caption.querySelector(".vmc-end-signs");
  if (!end) {
    end = Object.assign(document.createElement("span"), { className: "vmc-end-signs" });
    const last = caption.lastChild, word = last?.nodeType === Node.TEXT_NODE ? last.data.trimEnd().search(/\S+$/) : -1;
    if (word >= 0) end.append(last.splitText(word).data.trimEnd());
    if (word >= 0) last.nextSibling.remove();
    caption.append(end);
  }
  end.append("\u00a0", sign);
};

/* A demo's state in the page's address: `#demo-saliency?photo=1` says where each control stands. It is
   read when the page opens and when the address changes, and written when the reader moves a control;
   the sign at the caption's end is a link to it, also where Play or a law of the reader's has led.
   Returns what reads it for the first time, as soon as it is known whether sliders stand between their stops. */
export const addAddress = (demo) => {
  const inputs = [...demo.querySelectorAll("[data-stride]")];
  const caption = demo.querySelector("figcaption");
  if (!inputs.length || !caption || self.Reveal) return () => {}; // slides keep their own place in the address
  const name = (input) => (input.name || input.id).slice(demo.id.length + 1);
  const link = document.createElement("a");
  Object.assign(link, { className: "vmc-link", textContent: "#", title: "Link to what the demo shows now" });
  link.setAttribute("aria-label", link.title);
  addSign(caption, link);

  const state = () => {
    const places = new URLSearchParams();
    for (const input of inputs)
      if (input.type === "checkbox") places.set(name(input), +input.checked);
      else if (input.type !== "radio" || input.checked) places.set(name(input), input.value);
    for (const [key, law] of demo.vmcLaws?.() ?? []) places.set(key, law);
    return `#${demo.id}?${places}`;
  };

  /* What the address says of this demo. */
  const ownQuery = () => {
    const [id, places] = address();
    return id === demo.id ? places : undefined;
  };

  /* Put the controls where the address says, and between its stops a slider that may stand there. What follows a number
     came along, as a sentence's end does; what is none, as in a link that was cut, moves nothing. */
  let between = false;
  const read = () => {
    for (const [key, text] of new URLSearchParams(ownQuery())) {
      const place = parseFloat(text);
      if (!Number.isFinite(place)) continue;
      for (const input of inputs.filter((input) => name(input) === key)) {
        if (between && "between" in input.dataset && place % 1) input.step = 0.1; // else the browser rounds it
        moveTo(input, place);
      }
    }
  };

  /* Bring it into sight, out of whatever it is folded in. */
  const bringIntoSight = () => {
    for (let fold = demo; (fold = fold.parentElement.closest("details")); ) fold.open = true;
    demo.scrollIntoView({ block: "center" });
  };

  addEventListener("hashchange", () => {
    if (ownQuery() === undefined) return;
    read();
    demo.dispatchEvent(new Event("input", { bubbles: true }));
    bringIntoSight();
  });
  let waiting; // until the hand rests: browsers bear only so many new addresses a second
  demo.addEventListener("input", () => {
    const moved = state(), before = location.hash; // Play may soon go on from here, and leaves the address alone
    clearTimeout(waiting);
    waiting = setTimeout(() => { // a link that was followed meanwhile is still to be read
      if (location.hash === before) history.replaceState(history.state, "", moved);
    }, 200);
  });
  demo.addEventListener("vmc-shown", () => (link.href = state()));
  if (ownQuery() !== undefined) addEventListener("load", bringIntoSight); // pictures take their room
  return (free) => {
    between = free;
    read();
  };
};
