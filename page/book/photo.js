/* The script of the page with an eye: the reader's own photo. */
import "../eye/page.js";
import "./chapter.js";
