import { iou } from "../eye/boxes.js";
import { frame, inCorner } from "./photo.js";

/* Boxes, the best first, after so many steps of non-maximum suppression (book/figures/suppression.py). */
export const suppression = ({ boxes, edge, paint }, [step, overlap]) => {
  const all = { grey: boxes.map((_, i) => i), gone: [], red: [], green: [] }; // by their colours
  for (let k = 0; k < step; k++) {
    const [best, ...rest] = all.grey;
    all.gone.push(...all.red.splice(0));
    if (best === undefined) break;
    all.green.push(best);
    all.red = rest.filter((i) => iou(boxes[best], boxes[i]) > overlap);
    all.grey = rest.filter((i) => !all.red.includes(i));
  }
  const words = `${all.green.length} kept, ${all.gone.length + all.red.length} suppressed, ${all.grey.length} wait`;
  const frames = ["grey", "red", "green"].map((colour) => all[colour].map((i) => frame(boxes[i], paint[colour], edge)).join(""));
  return [`A photo with labels: ${words}.`, frames.join("") + inCorner(words, paint.ink, edge)];
};
suppression.between = true; // at any values
