/* In a page of its own (kit/demos.py) what an arm has from Python is packed. */
import { unzip } from "../vendored.js";
import { startAll } from "./start.js";

const start = async () => {
  const given = await unzip(document.getElementById("given.json").textContent).text();
  document.querySelector(".vmc-live > script").textContent = given;
  startAll();
};
start();
