/* A picture, drawn anew on a canvas, `scale` times as large; what is transparent stands on white. */
const vmcDrawScaled = (picture, scale, canvas) => {
  [canvas.width, canvas.height] = [picture.width, picture.height].map((side) => Math.round(scale * side));
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.fillStyle = "white";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingQuality = "high";
  context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  return context;
};
