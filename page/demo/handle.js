/* A handle on a plot or a photo, for a mouse or a finger: it stands at a place of the picture's axes,
   and is dragged over them. A mouse may press anywhere, a finger may tap, and the nearest handle comes;
   fingers that move beside it scroll the page. `moved(place)` hears where it is wanted, `dropped()` that it was let go; the
   function returned puts it at a place. The picture is the first, or another by its number, of those
   that have axes. */
import { axesOf } from "./axes.js";

export const addHandle = (pictures, moved, number, dropped) => {
  const handle = document.createElement("span");
  handle.className = "vmc-handle";
  handle.dataset.picture = number ?? 0;
  pictures.append(handle);
  const plot = () => pictures.querySelectorAll("svg[data-axes]")[number ?? 0];
  const distanceTo = (other, { clientX, clientY }) => {
    const { left, top, width, height } = other.getBoundingClientRect();
    return Math.hypot(clientX - left - width / 2, clientY - top - height / 2);
  };
  const isNearest = (event) =>
    event.target.closest("svg[data-axes]") === plot() &&
    [...pictures.querySelectorAll(`.vmc-handle[data-picture="${number ?? 0}"]`)].every((other) =>
      distanceTo(handle, event) <= distanceTo(other, event));
  let place, held = null; // by which pointer, and how far beside the handle's middle it was taken
  const holds = ({ pointerId }) => held?.pointer === pointerId;

  const put = () => {
    const [box, frame] = [plot(), pictures].map((element) => element.getBoundingClientRect());
    const [right, down] = axesOf(plot()).shareOf(place);
    const [x, y] = [box.left - frame.left + right * box.width, box.top - frame.top + down * box.height];
    handle.hidden = x < 0 || x > frame.width; // where a phone has scrolled it out of sight
    const zoom = frame.width / pictures.offsetWidth || 1; // a slide is drawn smaller until it fits
    handle.style.transform = `translate(${x / zoom}px, ${y / zoom}px)`;
  };

  const go = ({ clientX, clientY }, [x, y] = [0, 0]) =>
    moved(axesOf(plot()).placeAt({ clientX: clientX - x, clientY: clientY - y }));

  pictures.addEventListener("pointerdown", (event) => {
    if (event.button || (held && !holds(event))) return; // the others are the browser's; a second finger drags nothing
    const own = event.target === handle;
    if (!own && (event.pointerType === "touch" || !isNearest(event))) return;
    event.preventDefault(); // no text is selected on the way
    const { left, top, width, height } = handle.getBoundingClientRect();
    const beside = own ? [event.clientX - left - width / 2, event.clientY - top - height / 2] : [0, 0];
    held = { pointer: event.pointerId, beside };
    handle.setPointerCapture(event.pointerId);
    if (!own) go(event);
  });
  pictures.addEventListener("pointermove", (event) => holds(event) && go(event, held.beside));
  for (const type of ["pointerup", "pointercancel"])
    pictures.addEventListener(type, (event) => {
      if (!holds(event)) return;
      held = null;
      dropped?.();
    });
  pictures.addEventListener("click", (event) => {
    if (event.pointerType === "touch" && isNearest(event)) (go(event), dropped?.());
  });
  pictures.addEventListener("scroll", () => put(), true); // a wide plot scrolls on a phone
  new ResizeObserver(() => place && put()).observe(pictures);
  return (where) => ((place = where), put());
};
