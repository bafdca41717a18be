/* What is drawn on a photo of 600 × 400 as it becomes known: the sheet, boxes, a reach. Each lies on a layer of its
   own; bright strokes with a dark edge are seen on anything. */
const vmcPhotoMarks = (() => {
  "use strict";

  const points = (places) => places.map((place) => place.map((x) => x.toFixed(1)).join(",")).join(" ");

  class PhotoMarks {
    constructor(svg, { edge, paint }) {
      Object.assign(this, { svg, edge, paint });
      [this.sheet, this.boxes, this.reach] = svg.querySelectorAll("g");
      this.film = svg.previousElementSibling.getContext("2d");
    }

    /* Another photo, at an address, of which nothing is known. */
    show(address) {
      this.film.canvas.hidden = true;
      this.svg.querySelector("image").setAttribute("href", address);
      for (const layer of [this.sheet, this.boxes, this.reach]) layer.innerHTML = "";
    }

    /* A frame of a film, in place of the photo. */
    showFrame(pixels) {
      this.film.canvas.hidden = false;
      this.film.putImageData(pixels, 0, 0);
    }

    edged(shape, colour, width = 3) {
      return `<${shape} ${this.edge}/><${shape} stroke="${this.paint[colour]}" stroke-width="${width}"/>`;
    }

    ring([x, y], colour, radius) {
      return this.edged(`circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${radius}"`, colour);
    }

    drawSheet(outline) {
      this.sheet.innerHTML = this.edged(`polygon points="${points(outline)}"`, "blue");
    }

    drawCandidates(boxes) {
      const way = boxes.map(([x0, y0, x1, y1]) => `M${x0} ${y0}H${x1}V${y1}H${x0}Z`).join("");
      this.boxes.innerHTML = `<path d="${way}" stroke="${this.paint.grey}" stroke-width=".7" opacity=".7"/>`;
    }

    /* Boxes { box, colour, words }, the best last, so that it lies on top; those with words can be pointed at. */
    drawBoxes(marks, chosen) {
      const drawn = marks.map(({ box, colour, words }, i) => {
        const [x0, y0, x1, y1] = box.map((x) => +x.toFixed(1)), [width, height] = [x1 - x0, y1 - y0].map((x) => x.toFixed(1));
        const frame = this.edged(`rect x="${x0}" y="${y0}" width="${width}" height="${height}"`, colour, i === chosen ? 5 : 2.5);
        if (!words) return frame;
        const at = `x="${Math.max(x0, 0)}" y="${y0 > 26 ? y0 - 7 : y1 + 21}"`;
        return `<g data-box="${i}">${frame}<text ${at} fill="${this.paint[colour]}" ${this.edge} paint-order="stroke">${words}</text></g>`;
      });
      this.boxes.innerHTML = drawn.reverse().join("");
    }

    /* The place reached for, the hand's way, and where reaches ended: [place, colour] each. */
    drawReach(place, way, ends) {
      this.reach.innerHTML = [
        this.edged(`polyline points="${points(way)}"`, "orange"),
        this.ring(place, "green", 8),
        ...ends.map(([end, colour]) => this.ring(end, colour, 3)),
      ].join("");
    }
  }

  return { PhotoMarks };
})();
