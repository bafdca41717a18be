/* The reader's own photo, made small before it travels: the channel to a kernel carries a few MB. */
const vmcUpload = (box, _, ask) => {
  "use strict";

  const LARGEST = 1200; // pixels, of the longer side: the eye keeps half of them

  const small = async (file) => {
    const bitmap = await createImageBitmap(file);
    const scale = Math.min(1, LARGEST / Math.max(bitmap.width, bitmap.height));
    const canvas = document.createElement("canvas");
    if (!vmcDrawScaled(bitmap, scale, canvas)) throw vmcPixelsHidden;
    return canvas.toDataURL("image/jpeg", 0.92);
  };

  const [say, view] = ["[role=status]", ".vmc-picture"].map((name) => box.querySelector(name));
  box.querySelector("input").addEventListener("change", async ({ target }) => {
    const [file] = target.files;
    if (!file) return;
    view.innerHTML = "";
    say.textContent = `Looking at ${file.name} …`;
    const unread = "this browser cannot read it. Save it, or a phone's HEIC, as a JPEG or PNG.";
    const why = (error) => ({ error: error === vmcPixelsHidden ? error : unread });
    const drawn = await small(file).then((photo) => ask("photo", photo), why);
    say.textContent = `${file.name}: ${drawn.error ?? "seen."}`;
    if (!drawn.error) view.innerHTML = drawn;
  });
};
