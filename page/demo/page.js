/* In the page every demo starts by itself, once all scripts have run: some of them draw. */
import "./guess.js";
import { startAll } from "./demo.js";

if (document.readyState === "complete") startAll();
else addEventListener("DOMContentLoaded", startAll);
