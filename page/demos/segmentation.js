/* A photo falls into segments, which grow back: ours, or the reader's own, which never leaves the page. */
import { drawScaled, PIXELS_HIDDEN, takePictures } from "../canvas.js";
import { showRunning } from "../demo/running.js";
import { finish } from "../eye/pieces.js";
import { grow as growSegments, prepare, segment } from "../eye/selective_search.js";

export const start = (box) => {
  const AREA = 600 * 400, PLAY_TIME = 9000; // pixels, as our photos have; ms
  const [still, canvas, k, merged, play, choose, file, strip, say] = // as they stand in the page
    box.querySelectorAll("img, canvas, input, button, .vmc-strip, [role=status]");
  const scale = () => Math.round(2 ** k.value);
  let context, photo, prepared, tree, asked = 0;

  const look = (picture) => {
    context = drawScaled(picture, Math.sqrt(AREA / (picture.width * picture.height)), canvas);
    if (!context) {
      stop();
      strip.textContent = PIXELS_HIDDEN;
      return false;
    }
    photo = context.getImageData(0, 0, canvas.width, canvas.height);
    prepared = tree = null;
    return (canvas.hidden = true);
  };

  /* The segments and all regions above them, with their mean colours as four bytes. */
  const grow = () => {
    prepared ??= finish(prepare(photo, "HSV"));
    const segments = finish(segment(prepared, scale())), { labels } = segments;
    const { merges, boxes } = growSegments(segments, [true, true, true, true]), count = merges.length + 1;
    const sums = Array.from({ length: count }, () => [0, 0, 0, 0]);
    photo.data.forEach((byte, i) => (sums[labels[i >> 2]][i & 3] += byte));
    for (const [i, j] of merges) sums.push(sums[i].map((sum, c) => sum + sums[j][c]));
    const bytes = Uint8Array.from(sums.flatMap((sum) => sum.map((x) => (255 * x) / sum[3]))); // they are opaque
    tree = { scale: scale(), labels, count, merges, boxes, colours: new Int32Array(bytes.buffer) };
  };

  const draw = () => {
    if (tree?.scale !== scale()) grow();
    const { labels, count, merges, boxes, colours } = tree, { width, height } = photo;
    const left = Math.round(count ** (1 - merged.value)), regions = 2 * count - left, shown = colours.slice();
    for (let made = regions - 1; made >= count; made--)
      for (const part of merges[made - count]) shown[part] = shown[made];
    const pixels = labels.map((label) => shown[label]);
    context.putImageData(new ImageData(new Uint8ClampedArray(pixels.buffer), width), 0, 0);
    const [x0, y0, x1, y1] = boxes[regions - 1];
    for (const [colour, wide] of left < count ? [["black", 5], ["orange", 3]] : []) {
      Object.assign(context, { strokeStyle: colour, lineWidth: wide });
      context.strokeRect(x0, y0, x1 - x0, y1 - y0);
    }
    const text = (n) => n.toLocaleString("en-GB");
    k.nextElementSibling.textContent = scale();
    merged.nextElementSibling.textContent = `${text(left)} left`;
    if (canvas.hidden) {
      canvas.hidden = false;
      const fade = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 1500;
      canvas.animate({ opacity: [0, 1] }, fade).onfinish = draw;
    }
    if (canvas.getAnimations().length) return; // the words wait for the picture
    strip.textContent = `${text(regions)} region${regions > 1 ? "s" : ""} so far, a box around each, in ${width} × ${height} pixels.`;
  };

  /* To cut takes a moment: say so, and begin when that can be seen. Only the last who asked is answered. */
  const drawn = () => new Promise((done) => {
    const mine = ++asked;
    if (!photo && !look(still)) return;
    if (tree?.scale !== scale()) strip.textContent = "Cutting …";
    requestAnimationFrame(() => setTimeout(() => mine === asked && done(draw())));
  });
  const stop = () => {
    asked++;
    showRunning(play, false, "Play");
  };
  const run = async () => {
    showRunning(play, true, "Pause");
    merged.value %= 1;
    await drawn();
    const begun = performance.now() - PLAY_TIME * merged.value;
    while (+merged.value < 1) {
      merged.value = (performance.now() - begun) / PLAY_TIME;
      await drawn();
    }
    stop();
  };
  play.addEventListener("click", () => ("running" in play.dataset ? stop() : run()));
  for (const slider of [k, merged]) slider.addEventListener("input", () => { stop(); drawn(); });

  takePictures(box, file, (picture, { name }) => {
    say.textContent = `${name} stays in this page: it is sent nowhere.`;
    merged.value = 0;
    if (!look(picture)) return;
    still.src = canvas.toDataURL("image/jpeg", 0.9);
    run();
  }, (why) => (say.textContent = why));
  choose.addEventListener("click", () => file.click());
  box.dataset.ready = "";
  return stop;
};

/* In the page it starts by itself. */
export const startAll = () => document.querySelectorAll(".vmc-demo:has(> .vmc-segmentation)").forEach(start);
