/* A box on a photo. */
export const frame = ([x0, y0, x1, y1], stroke, edge) => {
  const at = `x="${x0}" y="${y0}" width="${x1 - x0}" height="${y1 - y0}"`;
  return `<rect ${at} ${edge}/><rect ${at} stroke="${stroke}"/>`;
};

/* Words in a photo's upper left corner (book/figures/where.py, in_corner). */
export const inCorner = (words, colour, edge) => frame([8, 0, 8, 0], colour, edge) +
  `<text x="8" y="21" fill="${colour}" ${edge} paint-order="stroke">${words}</text>`;
