import { iou } from "../eye/boxes.js";
import { minus, plus, times } from "../vectors.js";
import { frame, inCorner } from "./photo.js";

/* Two boxes on a photo: the object's, and one whose middle and whose size the reader drags. */
export const overlap = ({ object, edge, paint }, [x, y, wide, high]) => {
  const box = [x - wide / 2, y - high / 2, x + wide / 2, y + high / 2];
  const shared = iou(box, object).toFixed(2);
  const colour = shared >= 0.8 ? paint.green : shared > 0.5 ? paint.orange : paint.red;
  return [
    `A box around ${x.toFixed(0)}, ${y.toFixed(0)}, ${wide.toFixed(0)} × ${high.toFixed(0)}: IoU ${shared}.`,
    frame(object, paint.grey, edge) + frame(box, colour, edge) + inCorner(`IoU ${shared}`, colour, edge),
  ];
};
overlap.views = () => [
  { toView: (middle) => middle, fromView: (seen) => seen },
  {
    pad: 1,
    toView: (size, [middle]) => plus(middle, times(0.5, size)),
    fromView: (corner, [middle]) => times(2, minus(corner, middle)),
  },
];
overlap.between = true; // at any values
