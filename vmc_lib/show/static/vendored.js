/* Fetches a vendored script from the book's own files, or from a live kernel: a promise that settles
   when it has run. */
const vmcVendored = (() => {
  "use strict";

  const here = document.currentScript?.src;
  return (name) =>
    self.vmcKernel?.(name) ??
    new Promise((resolve, reject) => {
      const tag = document.createElement("script");
      tag.src = new URL(`vendor/${name}`, here);
      Object.assign(tag, { onload: resolve, onerror: () => reject(new Error(`no ${tag.src}`)) });
      document.head.append(tag);
    });
})();

/* What base64 holds of something gzipped, as a response: its JSON, its bytes. */
const vmcUnzip = (base64) => {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i); // `from` takes four times as long
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream);
};
