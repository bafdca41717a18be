"""Texts that a spreadsheet would take for formulas, wherever it cuts a line of CSV."""

import re

STARTS = "=1+1", "+1", "-1", "@SUM(1)", "\t=1", "\r=1", "\n=1", " =1", '"=1', "＝1"
FORMULAS = [*STARTS, *map("a;{}".format, STARTS)]  # a semicolon separates in much of Europe


def computes(cell):
    """Whether a spreadsheet may take some part of a cell for a formula."""
    parts = re.split(r"[;\t\r\n]", cell)
    return any(re.match(r'[\s"]*[=+@＝＋－＠-]', part) for part in parts)
