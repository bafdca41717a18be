const vmcPixelsHidden =
  "This browser hides a picture's pixels from pages (fingerprinting protection): allow it for this page.";

/* A picture, drawn anew on a canvas, `scale` times as large; what is transparent stands on white.
   Null where the browser hides what a canvas holds. */
const vmcDrawScaled = (picture, scale, canvas) => {
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

/* A picture in the middle of a grey one of another size: its pixels (vmc_lib/photos.py, read_image). */
const vmcLetterbox = (picture, ...whole) => {
  const [width, height] = whole, canvas = Object.assign(document.createElement("canvas"), { width, height });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const sides = [picture.width, picture.height], scale = Math.min(...whole.map((side, k) => side / sides[k]));
  const size = sides.map((side) => Math.max(1, Math.round(scale * side)));
  context.fillStyle = "rgb(128 128 128)";
  context.fillRect(0, 0, width, height);
  context.imageSmoothingQuality = "high";
  context.drawImage(picture, ...whole.map((side, k) => (side - size[k]) >> 1), ...size);
  return context.getImageData(0, 0, width, height);
};
