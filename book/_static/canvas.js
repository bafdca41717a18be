const vmcPixelsHidden =
  "This browser hides a picture's pixels from pages (fingerprinting protection): allow it for this page.";

/* A picture, drawn anew on a canvas, `scale` times as large; what is transparent stands on white.
   Null where the browser hides what a canvas holds. */
const vmcDrawScaled = (picture, scale, canvas) => {
  [canvas.width, canvas.height] = [picture.width, picture.height].map((side) => Math.round(scale * side));
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
