/* Fetches a vendored script from the book's own files, from a live kernel, or out of a page that holds it
   packed, as an element of its name: a promise that settles when it has run. */
const vmcVendored = (() => {
  "use strict";

  const here = document.currentScript?.src;
  const unpack = async (packed) => {
    const text = await vmcUnzip(packed.textContent).text();
    document.head.append(Object.assign(document.createElement("script"), { text }));
  };
  const fetch = (name) =>
    new Promise((resolve, reject) => {
      const tag = document.createElement("script");
      tag.src = new URL(`vendor/${name}`, here);
      Object.assign(tag, { onload: resolve, onerror: () => reject(new Error(`no ${tag.src}`)) });
      document.head.append(tag);
    });
  return (name) => {
    const packed = document.querySelector(`script[id="${name}"]`);
    return self.vmcKernel?.(name) ?? (packed ? unpack(packed) : fetch(name));
  };
})();

/* What base64 holds of something gzipped, as a response: its JSON, its bytes. */
const vmcUnzip = (base64) => {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i); // `from` takes four times as long
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream);
};
