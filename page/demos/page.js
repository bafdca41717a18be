import { startAll } from "./segmentation.js";

startAll();
