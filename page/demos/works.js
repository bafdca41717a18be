/* What the book's demos work out in the page, for any position of the reader's hand (vmc_lib.show.explore,
   `in_page`). Each takes what Python gave, the control's values, the pictures' axes, and the place of these
   values among all; it returns what is seen in words, and the marks on each picture. */
import { works } from "../demo/demo.js";
import { aim } from "./aim.js";
import { bells } from "./bells.js";
import { block } from "./block.js";
import { line } from "./line.js";
import { margin } from "./margin.js";
import { overlap } from "./overlap.js";
import { plan } from "./plan.js";
import { suppression } from "./suppression.js";
import { trade } from "./trade.js";
import { votes } from "./votes.js";

Object.assign(works, { aim, bells, block, line, margin, overlap, plan, suppression, trade, votes });
