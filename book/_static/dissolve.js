/* A photo falls into segments, which grow back: ours, or the reader's own, which never leaves the page. */
const vmcDissolve = (() => {
  "use strict";

  const AREA = 600 * 400, PLAY_TIME = 9000; // pixels, as our photos have; ms

  const start = (box) => {
    const [still, canvas, strip, say, file] = ["img", "canvas", ".vmc-strip", "[role=status]", "[type=file]"]
      .map((name) => box.querySelector(name));
    const [k, merged] = box.querySelectorAll("[type=range]");
    const [play, choose] = box.querySelectorAll("button");
    let context, photo, tree, asked = 0;

    const look = (picture) => {
      context = vmcRedrawn(picture, Math.sqrt(AREA / (picture.width * picture.height)), canvas);
      const { data, width, height } = context.getImageData(0, 0, canvas.width, canvas.height);
      photo = { data, image: new ImageData(width, height) };
      tree = null;
      canvas.hidden = true;
    };

    /* The segments and all regions above them, with their mean colours as four bytes. */
    const grow = (scale) => {
      photo.grow ??= vmcSearch.prepare(photo.data, canvas.width, canvas.height).grow;
      const grown = photo.grow(scale), { labels, merges, size } = grown, sums = Array.from(size, () => [0, 0, 0]);
      labels.forEach((label, i) => { for (let c = 0; c < 3; c++) sums[label][c] += photo.data[4 * i + c]; });
      merges.forEach(([i, j], made) => (sums[grown.count + made] = sums[i].map((sum, c) => sum + sums[j][c])));
      const bytes = Uint8Array.from(sums.flatMap((sum, i) => [...sum.map((x) => x / size[i]), 255]));
      tree = { scale, ...grown, colours: new Uint32Array(bytes.buffer) };
    };

    const draw = () => {
      const scale = Math.round(2 ** k.value);
      if (tree?.scale !== scale) grow(scale);
      const { labels, count, merges, boxes, colours } = tree, { width, height } = canvas;
      const left = Math.max(1, Math.round(count ** (1 - merged.value))), regions = 2 * count - left;
      const into = Uint32Array.from({ length: regions }, (_, i) => i), pixels = new Uint32Array(photo.image.data.buffer);
      for (let made = regions - 1; made >= count; made--) for (const part of merges[made - count]) into[part] = into[made];
      labels.forEach((label, i) => (pixels[i] = colours[into[label]]));
      context.putImageData(photo.image, 0, 0);
      const [x0, y0, x1, y1] = boxes[regions - 1];
      for (const [colour, wide] of left < count ? [["black", 5], ["orange", 3]] : []) {
        Object.assign(context, { strokeStyle: colour, lineWidth: wide });
        context.strokeRect(x0, y0, x1 - x0, y1 - y0);
      }
      const all = (width * (width + 1) * height * (height + 1)) / 4, told = (n) => n.toLocaleString("en-GB");
      [k, merged].forEach((slider, i) => (slider.nextElementSibling.textContent = [scale, `${told(left)} left`][i]));
      if (canvas.hidden) {
        canvas.hidden = false;
        const fade = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 1500;
        canvas.animate({ opacity: [0, 1] }, fade).onfinish = draw;
      }
      if (canvas.getAnimations().length) return; // the words wait for the picture
      strip.textContent = `${told(regions)} regions so far, a box around each; ${width} × ${height} pixels hold ${told(all)} boxes.`;
    };

    /* To cut takes a moment: say so, and begin when that can be seen. The last who asked is heard. */
    const soon = (then) => {
      if (!photo) look(still);
      if (tree?.scale !== Math.round(2 ** k.value)) strip.textContent = "Cutting …";
      const mine = ++asked;
      requestAnimationFrame(() => setTimeout(() => mine === asked && then()));
    };
    const stop = () => {
      asked++;
      play.textContent = "Play";
    };
    const run = () => {
      const from = merged.value % 1;
      let begun;
      const step = () => {
        draw();
        if (+merged.value === 1) return stop();
        begun ??= performance.now();
        merged.value = Math.min(1, from + (performance.now() - begun) / PLAY_TIME);
        soon(step);
      };
      merged.value = from;
      play.textContent = "Pause";
      soon(step);
    };
    play.addEventListener("click", () => (play.textContent === "Play" ? run() : stop()));
    for (const slider of [k, merged]) slider.addEventListener("input", () => { stop(); soon(draw); });

    const own = async (chosen) => {
      if (!chosen) return;
      stop();
      const picture = await createImageBitmap(chosen).catch(() => null);
      say.textContent = picture ? `${chosen.name} stays in this page: it is sent nowhere.`
        : `This browser cannot read ${chosen.name}: save it, or a phone's HEIC, as a JPEG or PNG.`;
      if (!picture) return;
      merged.value = 0;
      look(picture);
      still.src = canvas.toDataURL("image/jpeg", 0.9);
      run();
    };
    file.addEventListener("change", () => own(file.files[0]).then(() => (file.value = "")));
    choose.addEventListener("click", () => file.click());
    box.addEventListener("dragover", (event) => event.preventDefault());
    box.addEventListener("drop", (event) => { event.preventDefault(); own(event.dataTransfer.files[0]); });
    box.dataset.ready = "";
    return stop;
  };

  /* A kernel starts its own. */
  if (!self.vmcKernel) document.querySelectorAll(".vmc-demo:has(> .vmc-dissolve)").forEach(start);
  return start;
})();
