/* The reader's own photo, made small before it travels: the channel to a kernel carries a few MB. */
import { drawScaled, PIXELS_HIDDEN, takePictures } from "../canvas.js";

const LARGEST = 1200; // pixels, of the longer side: the eye keeps half of them

export const start = (box, ask) => {
  const [say, view, input] = ["[role=status]", ".vmc-picture", "input"].map((name) => box.querySelector(name));
  const tell = (words) => ([say.textContent, view.innerHTML] = [words, ""]);

  takePictures(box, input, async (picture, { name }, isLatest) => {
    const scale = Math.min(1, LARGEST / Math.max(picture.width, picture.height)), canvas = document.createElement("canvas");
    tell(`Looking at ${name} …`);
    if (!drawScaled(picture, scale, canvas)) return tell(PIXELS_HIDDEN);
    const drawn = await ask("photo", canvas.toDataURL("image/jpeg", 0.92));
    if (!isLatest()) return;
    tell(`${name}: ${drawn.error ?? "seen."}`);
    if (!drawn.error) view.innerHTML = drawn;
  }, tell);
};
