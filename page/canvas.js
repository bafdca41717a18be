export const PIXELS_HIDDEN =
  "This browser hides a picture's pixels from pages (fingerprinting protection): allow it for this page.";

/* A picture, drawn anew on a canvas, `scale` times as large; what is transparent stands on white.
   Null where the browser hides what a canvas holds. */
export const drawScaled = (picture, scale, canvas) => {
  [canvas.width, canvas.height] = [picture.width, picture.height].map((side) => Math.max(1, Math.round(scale * side)));
  const context = canvas.getContext("2d", { willReadFrequently: true }), known = [12, 34, 56];
  const fill = (colour) => {
    context.fillStyle = colour;
    context.fillRect(0, 0, canvas.width, canvas.height);
  };
  fill(`rgb(${known})`);
  const { data } = context.getImageData(0, 0, 1, 1);
  if (known.some((byte, k) => Math.abs(byte - data[k]) > 1)) return null; // 1: what some add changes no picture
  fill("white");
  context.imageSmoothingQuality = "high";
  context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  return context;
};

/* The reader's own pictures, chosen or dropped on a box: `take(picture, file, isLatest)` is given each that this
   browser can read, and can ask whether another came since; `say` why it cannot. Returns what takes a file, or an
   image of the page's. */
export const takePictures = (box, input, take, say) => {
  let latest;
  const read = async (file) => {
    latest = file;
    const isLatest = () => file === latest;
    if (!file) return say("That was no file: save the photo first, then choose it here.");
    const decoded = file instanceof Image ? file.decode().then(() => file) : createImageBitmap(file);
    const picture = await decoded.catch(() => null);
    if (!isLatest()) return; // a large one takes long, and the reader has chosen another
    if (picture) return take(picture, file, isLatest);
    say(`This browser cannot read ${file.name}: save it, or a phone's HEIC, as a JPEG or PNG.`);
  };
  input.addEventListener("change", () => {
    const [file] = input.files;
    input.value = ""; // so that the same file can be chosen again
    read(file);
  });
  box.addEventListener("dragover", (event) => event.preventDefault());
  box.addEventListener("drop", (event) => {
    event.preventDefault();
    read(event.dataTransfer.files[0]);
  });
  return read;
};

/* How many times as large a picture is where it fills a size, whole. */
export const fitScale = (picture, width, height) => Math.min(width / picture.width, height / picture.height);

/* Draw a picture in the middle of a context's canvas, whole, on grey (vmc_lib/photos.py, read_image). */
export const drawLetterboxed = (context, picture) => {
  const { width, height } = context.canvas, scale = fitScale(picture, width, height);
  const size = [picture.width, picture.height].map((side) => Math.max(1, Math.round(scale * side)));
  context.fillStyle = "rgb(128 128 128)";
  context.fillRect(0, 0, width, height);
  context.imageSmoothingQuality = "high";
  context.drawImage(picture, (width - size[0]) >> 1, (height - size[1]) >> 1, ...size);
};

/* The pixels of a picture, letterboxed to a size. All are drawn on one canvas: those of a film's frames would fill the
   memory before the browser collects them. */
export const letterbox = (() => {
  const canvas = document.createElement("canvas"), context = canvas.getContext("2d", { willReadFrequently: true });
  return (picture, width, height) => {
    Object.assign(canvas, { width, height });
    drawLetterboxed(context, picture);
    return context.getImageData(0, 0, width, height);
  };
})();

const LINE = 60; // pixels

/* Save what is on a canvas, and below it a line of words, as a file of a name. */
export const saveWithLine = (picture, words, download) => {
  const { width, height } = picture, canvas = Object.assign(document.createElement("canvas"), { width, height: height + LINE });
  const context = canvas.getContext("2d");
  context.fillStyle = "white";
  context.fillRect(0, 0, width, height + LINE);
  context.drawImage(picture, 0, 0);
  Object.assign(context, { fillStyle: "black", font: `${0.4 * LINE}px sans-serif`, textBaseline: "middle" });
  context.fillText(words, LINE / 2, height + LINE / 2, width - LINE);
  const href = canvas.toDataURL("image/jpeg", 0.92);
  Object.assign(document.createElement("a"), { href, download }).click();
};
