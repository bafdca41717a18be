/* What the page's Python draws is data, whatever a reader's lines made of it: of its markup only what pictures
   and tables are made of becomes part of the page. */
const set = (words) => new Set(words.split(" "));
const ELEMENTS = set("svg g defs clipPath linearGradient stop use path rect circle ellipse line polyline polygon text tspan " +
  "image img div p span b strong em i code sub sup br a table caption thead tbody tr th td");
const ATTRIBUTES = set("alt class clip-path clip-rule colspan cx cy d dx dy fill fill-opacity fill-rule font-family font-size " +
  "font-style font-weight gradientUnits height href id offset opacity paint-order points preserveAspectRatio r role rowspan rx " +
  "ry scope src stop-color stop-opacity stroke stroke-dasharray stroke-linecap stroke-linejoin stroke-opacity stroke-width " +
  "style tabindex text-anchor transform version vector-effect viewBox width x x1 x2 xlink:href xmlns xmlns:xlink y y1 y2 " +
  "aria-hidden aria-label data-axes data-course data-curve");
const CLASSES = set("vmc-forest vmc-image vmc-key vmc-panels vmc-strip"); // the theme has some that cover the page
const STYLES = /^(--|fill|stroke|stop|opacity|font|text-anchor|image-rendering|vector-effect)/;
// With a digit or a hyphen, and no dot, or Matplotlib's, which may lack both: no name of a script's, or a file's
const IDS = /^(?=.*[\d-])[\w-]+$|^p[\da-f]{10}$/;
const PLACES = /^#[\w-]+$|^\s*data:image\/(png|jpeg|webp);base64,[\w+/=\s]*$/; // in the page, or a photo of its own

const isAllowed = (name, value) => {
  if (!ATTRIBUTES.has(name)) return false;
  if (name === "id") return IDS.test(value);
  if (name === "class") return value.split(" ").every((one) => CLASSES.has(one));
  if (/href$|^src$/.test(name)) return PLACES.test(value);
  return !/url\(\s*["']?(?!#)|image-set|\\/i.test(value);
};

/* Take out of a part of a document, which stands in no page yet, what is not among these. */
export const clean = (part) => {
  for (const node of part.querySelectorAll("*")) {
    if (!ELEMENTS.has(node.localName)) { node.remove(); continue; }
    for (const { name, value } of [...node.attributes]) if (!isAllowed(name, value)) node.removeAttribute(name);
    for (const name of [...node.style]) if (!STYLES.test(name)) node.style.removeProperty(name);
  }
  return part;
};

/* The same of a scene's messages: the page knows the anatomy, and its names. */
export const cleanMessages = (messages) => messages.filter((message) => !message.startsWith("anatomy|"));
