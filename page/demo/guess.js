/* The reader's guess, drawn on the figure beside what came out: a dashed line where the choice lies on an
   axis of the next figure's first plot. The prediction says where, `data-guess="y 0.1 0.67 1"`: the axis
   ("log y" for a logarithmic one), and a place for each choice. */
import { clip } from "../vectors.js";
import { axesOf } from "./axes.js";

const drawGuess = (question) => {
  const words = question.dataset.guess.split(" "), log = words[0] === "log" && words.shift();
  const [axis, ...places] = words, nth = "xy".indexOf(axis);
  const follows = (figure) => question.compareDocumentPosition(figure) & Node.DOCUMENT_POSITION_FOLLOWING;
  const pictures = [...document.querySelectorAll(".vmc-demo .vmc-pictures")].find(follows);
  const line = Object.assign(document.createElement("span"), { className: "vmc-guess", textContent: "your guess" });
  line.dataset.axis = axis;
  line.setAttribute("aria-hidden", true); // the question says the same
  pictures.append(line);

  const put = () => {
    const chosen = [...question.querySelectorAll("input")].findIndex(({ checked }) => checked);
    line.hidden = chosen < 0;
    if (line.hidden) return;
    const plot = pictures.querySelector("svg[data-axes]");
    const { left, right, bottom, top, share } = axesOf(plot);
    const along = clip(share(+places[chosen], nth, log), 0, 1); // at the edge, if beyond
    const [box, frame] = [plot, pictures].map((element) => element.getBoundingClientRect());
    const at = [box.left - frame.left + left * box.width, box.top - frame.top + top * box.height];
    const size = [(right - left) * box.width, (bottom - top) * box.height];
    at[nth] += size[nth] * (nth ? 1 - along : along);
    line.dataset.late = along > 0.5;
    line.style.translate = at.map((x) => `${x}px`).join(" ");
    line.style[nth ? "width" : "height"] = `${size[1 - nth]}px`;
  };

  question.addEventListener("change", put);
  pictures.addEventListener("scroll", put, true); // a wide plot scrolls on a phone
  new ResizeObserver(put).observe(pictures);
  new MutationObserver(put).observe(pictures, { subtree: true, attributeFilter: ["data-axes"] });
};

addEventListener("load", () => document.querySelectorAll("[data-guess]").forEach(drawGuess)); // once what was kept is chosen
