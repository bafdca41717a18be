/* A photo falls into segments, which grow back: ours, or the reader's own, which never leaves the page. */
import { drawScaled, PIXELS_HIDDEN, takePictures } from "../canvas.js";
import { calm, showRunning } from "../demo/running.js";
import { finish } from "../eye/pieces.js";
import { grow as growSegments, prepare, segment } from "../eye/selective_search.js";

const AREA = 600 * 400, PLAY_TIME = 9000; // pixels, as our photos have; ms
const text = (n) => n.toLocaleString("en-GB");

/* A picture on a canvas that is not shown yet, and its pixels; null where the browser hides them. */
const take = (picture, canvas) => {
  const context = drawScaled(picture, Math.sqrt(AREA / (picture.width * picture.height)), canvas);
  if (!context) return null;
  canvas.hidden = true;
  return { context, pixels: context.getImageData(0, 0, canvas.width, canvas.height) };
};

/* A photo's segments at a scale and all regions above them, with their mean colours as four bytes. */
const grow = (photo, scale) => {
  photo.prepared ??= finish(prepare(photo.pixels, "HSV"));
  const segments = finish(segment(photo.prepared, scale)), { labels } = segments;
  const { merges, boxes } = growSegments(segments, [true, true, true, true]), count = merges.length + 1;
  const sums = Array.from({ length: count }, () => [0, 0, 0, 0]);
  photo.pixels.data.forEach((byte, i) => (sums[labels[i >> 2]][i & 3] += byte));
  for (const [i, j] of merges) sums.push(sums[i].map((sum, c) => sum + sums[j][c]));
  const bytes = Uint8Array.from(sums.flatMap((sum) => sum.map((x) => (255 * x) / sum[3]))); // they are opaque
  return { scale, labels, count, merges, boxes, colours: new Int32Array(bytes.buffer) };
};

/* Colour each segment as the last of so many regions that it lies in, and frame the newest of them. */
const paint = (context, { labels, count, merges, boxes, colours }, regions) => {
  const shown = colours.slice();
  for (let made = regions - 1; made >= count; made--)
    for (const part of merges[made - count]) shown[part] = shown[made];
  const pixels = labels.map((label) => shown[label]);
  context.putImageData(new ImageData(new Uint8ClampedArray(pixels.buffer), context.canvas.width), 0, 0);
  const [x0, y0, x1, y1] = boxes[regions - 1];
  for (const [colour, wide] of regions > count ? [["black", 5], ["orange", 3]] : []) {
    Object.assign(context, { strokeStyle: colour, lineWidth: wide });
    context.strokeRect(x0, y0, x1 - x0, y1 - y0);
  }
};

const fadeIn = (canvas) => {
  canvas.hidden = false;
  return canvas.animate({ opacity: [0, 1] }, calm.matches ? 0 : 1500);
};

class Segmentation {
  constructor(box) {
    const [still, canvas, k, merged, play, choose, back, file, strip, say] = // as they stand in the page
      box.querySelectorAll("img, canvas, input, button, .vmc-strip, [role=status]");
    Object.assign(this, { still, canvas, k, merged, play, strip, asked: 0 });
    play.addEventListener("click", () => ("running" in play.dataset ? this.stop() : this.run()));
    for (const slider of [k, merged]) slider.addEventListener("input", () => { this.stop(); this.show(); });
    takePictures(box, file, (picture, { name }) => {
      say.textContent = `${name} stays in this page: it is sent nowhere.`;
      merged.value = 0;
      if (!this.look(picture)) return;
      back.hidden = false;
      still.src = canvas.toDataURL("image/jpeg", 0.9);
      this.run();
    }, (why) => (say.textContent = why));
    choose.addEventListener("click", () => file.click());
    const ours = still.cloneNode();
    back.addEventListener("click", () => {
      this.stop();
      [back.hidden, merged.value, say.textContent, still.src] = [true, 0, "", ours.src];
      this.look(ours);
      this.show();
    });
  }

  get scale() {
    return Math.round(2 ** this.k.value);
  }

  look(picture) {
    this.photo = take(picture, this.canvas);
    if (!this.photo) {
      this.stop();
      this.strip.textContent = PIXELS_HIDDEN;
    }
    return this.photo;
  }

  draw() {
    const { photo, scale, canvas, k, merged } = this;
    if (photo.tree?.scale !== scale) photo.tree = grow(photo, scale);
    const { count } = photo.tree, left = Math.round(count ** (1 - merged.value)), regions = 2 * count - left;
    paint(photo.context, photo.tree, regions);
    k.nextElementSibling.textContent = scale;
    merged.nextElementSibling.textContent = `${text(left)} left`;
    if (canvas.hidden) fadeIn(canvas).onfinish = () => this.draw();
    if (canvas.getAnimations().length) return; // the words wait for the picture
    const all = `${text(regions)} region${regions > 1 ? "s" : ""} made so far, a box around each`;
    this.strip.textContent = `${all}, in ${canvas.width} × ${canvas.height} pixels.`;
  }

  /* To cut takes a moment: say so, and begin when that can be seen. Only the last who asked is answered. */
  show() {
    const mine = ++this.asked;
    return new Promise((done) => {
      if (!this.photo && !this.look(this.still)) return;
      if (this.photo.tree?.scale !== this.scale) this.strip.textContent = "Cutting …";
      requestAnimationFrame(() => setTimeout(() => mine === this.asked && done(this.draw())));
    });
  }

  stop() {
    this.asked++;
    showRunning(this.play, false, "Play");
  }

  async run() {
    const { merged } = this;
    showRunning(this.play, true, "Pause");
    merged.value %= 1;
    await this.show();
    const begun = performance.now() - PLAY_TIME * merged.value;
    while (+merged.value < 1) {
      merged.value = (performance.now() - begun) / PLAY_TIME;
      await this.show();
    }
    this.stop();
  }
}

export const start = (box) => {
  const demo = new Segmentation(box);
  box.dataset.ready = "";
  return () => demo.stop();
};

/* In the page it starts by itself. */
export const startAll = () => document.querySelectorAll(".vmc-demo:has(> .vmc-segmentation)").forEach(start);
