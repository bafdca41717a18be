/* The script of a page of words. */
import "../demo/questions.js";
import "./book.js";
