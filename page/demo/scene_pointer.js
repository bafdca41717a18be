/* A mouse or a finger on a scene: dragging turns it, pointing at a muscle names it. Fingers that move
   up or down scroll the page. */
import { clip } from "../vectors.js";

export const addPointer = (view, canvas) => {
  const tip = document.createElement("span");
  tip.className = "vmc-tip";
  canvas.append(tip);
  let held = null;
  const holds = ({ pointerId }) => held?.pointer === pointerId;
  const point = (k) => view.body?.muscles.point(k ?? view.chosen?.() ?? null);

  const under = ({ clientX, clientY }) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const place = [(2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height];
    const k = view.body?.muscles.muscleAt(place) ?? null;
    tip.textContent = k === null ? "" : view.anatomy.muscles[k].name;
    tip.style.transform = `translate(${clientX - left + 12}px, ${clientY - top - 24}px)`;
    return k;
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button || (held && !holds(event))) return; // the others are the browser's; a second finger turns nothing
    held = { pointer: event.pointerId, x: event.clientX, y: event.clientY, turned: view.turned, raised: view.raised };
    canvas.setPointerCapture(event.pointerId);
    const k = under(event);
    point(k);
    if (k !== null) view.onmuscle?.(k);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return point(under(event));
    if (!holds(event)) return;
    const [right, down] = [event.clientX - held.x, event.clientY - held.y];
    const turned = ((held.turned - 0.5 * right + 540) % 360) - 180;
    const raised = event.pointerType === "touch" ? view.raised : held.raised + 0.3 * down;
    view.turn(turned, clip(raised, -30, 70));
  });
  for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, (event) => holds(event) && (held = null));
  canvas.addEventListener("pointerleave", () => {
    tip.textContent = "";
    point(null);
  });
};
