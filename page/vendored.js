/* Fetches a vendored script from the book's own files, from a live kernel, or out of a page that holds it
   packed, as an element of its name: a promise that settles when it has run. */
const here = document.currentScript?.src;
let lender; // in a notebook

const unpack = async (packed) => {
  const text = await unzip(packed.textContent).text();
  document.head.append(Object.assign(document.createElement("script"), { text }));
};
const load = (name) =>
  new Promise((resolve, reject) => {
    const tag = document.createElement("script");
    tag.src = new URL(`vendor/${name}`, here);
    Object.assign(tag, { onload: resolve, onerror: () => reject(new Error(`no ${tag.src}`)) });
    document.head.append(tag);
  });

export const fetchVendored = (name) => {
  const packed = document.querySelector(`script[id="${name}"]`);
  return lender?.(name) ?? (packed ? unpack(packed) : load(name));
};

/* From now on `fetch(name)` promises it, from a live kernel. */
export const lend = (fetch) => (lender = fetch);

/* `load`, which promises something, as a function that loads it once; again only if that failed. */
export const once = (load) => {
  let loading;
  return () => (loading ??= load().catch((error) => {
    loading = null;
    throw error;
  }));
};

/* What base64 holds of something gzipped, as a response: its JSON, its bytes. */
export const unzip = (base64) => {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i); // `from` takes four times as long
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream);
};
