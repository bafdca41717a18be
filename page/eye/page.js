import { startAll } from "./live_photo.js";

startAll();
