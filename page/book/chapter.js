/* The script of a page with something to move: a chapter. */
import "../arm/page.js";
import "../demo/page.js";
import "../demo/questions.js";
import "../demos/page.js";
import "../demos/works.js";
import "../python/grade.js";
import "../python/laws.js";
import "../python/measure.js";
import "./book.js";
import "./record.js";
