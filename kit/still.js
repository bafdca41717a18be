/* Makes a built page stand still, for paper: its demos as pictures in one or two positions, nothing folded,
   and ids and links that hold where all pages are one. Returns the article's HTML. */
async (root) => {
  const article = document.querySelector("article");
  document.documentElement.dataset.theme = "light";

  /* The demo as it looks now: its pictures, and where its controls stand. */
  const look = async (demo) => {
    const scenes = [...demo.querySelectorAll(".vmc-scene")].map(vmc["demo/scene"].viewOf);
    for (const scene of scenes) await scene.wake();
    for (const time of demo.querySelectorAll(".vmc-clock:not([hidden]) input")) {
      time.value = time.max; // where the movement leads
      time.dispatchEvent(new Event("input"));
    }
    const images = scenes.map((scene) => scene.viewer.capture_image());
    for (const input of demo.querySelectorAll("input")) input.toggleAttribute("checked", input.checked);
    for (const option of demo.querySelectorAll("option"))
      option.toggleAttribute("selected", option.selected);
    const shot = document.createElement("div");
    shot.className = "vmc-demo";
    shot.append(...[...demo.querySelectorAll(".vmc-pictures, .vmc-controls:not(.vmc-more *)")].map((n) => n.cloneNode(true)));
    shot.querySelectorAll(".vmc-scene").forEach((scene, i) => {
      scene.replaceChildren(Object.assign(new Image(), { src: images[i] }));
    });
    return shot;
  };

  for (const demo of article.querySelectorAll("figure.vmc-demo")) {
    if (demo.querySelector(".vmc-live")) continue; // it waits for its reader
    const shots = [], { printed } = demo.querySelector("form")?.dataset ?? {};
    for (const state of printed?.split(" ") ?? []) {
      history.replaceState(null, "", `#${demo.id}?${state}`); // as if a link led there
      dispatchEvent(new HashChangeEvent("hashchange"));
      shots.push(await look(demo));
    }
    if (!printed) shots.push(await look(demo));
    const slider = demo.querySelector("input[data-stride][type=range]");
    if (slider && !printed) {
      slider.value = slider.value === slider.max ? 0 : slider.max;
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      shots.push(await look(demo));
    }
    demo.replaceChildren(...shots, ...demo.querySelectorAll(":scope > figcaption"));
  }

  const folded = "details:not(fieldset details), .solution, .vmc-live-form, .vmc-link, .headerlink";
  article.querySelectorAll(`script, button, ${folded}`).forEach((node) => node.remove());
  article.querySelectorAll("img").forEach((image) => (image.src = image.src));

  const folder = new URL(root).pathname;
  const name = (path) => decodeURIComponent(path.replace(folder, "")).replace(/\.html$/, "");
  const here = name(location.pathname);
  article.id = here;
  article.querySelectorAll("[id]:not(svg *)").forEach((node) => (node.id = `${here}#${node.id}`));
  for (const link of article.querySelectorAll("a[href]")) {
    const { protocol, pathname, hash } = new URL(link.href);
    if (protocol === "file:") link.href = `#${name(pathname)}${decodeURIComponent(hash)}`;
  }
  return article.outerHTML;
}
