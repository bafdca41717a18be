"""The laws of the chapters: what a reader can change in the built page."""

import ast


def law_cells(cells):
    """The cells whose functions a reader can change, an exercise's left out."""
    tags = ({*cell.metadata.get("tags", [])} for cell in cells)
    pairs = zip(cells, tags, strict=True)
    return [cell for cell, has in pairs if "runs-in-page" in has and "raises-exception" not in has]


def functions(cell):
    """The functions that a cell defines, as Python reads them."""
    return [one for one in ast.parse(cell.source).body if isinstance(one, ast.FunctionDef)]
