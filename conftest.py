"""A chapter's test (`pytest --nbmake book/NAME.ipynb`) is its execution, the build's own."""

from pathlib import Path

import pytest
from nbmake.nb_result import NotebookError, NotebookResult
from nbmake.nb_run import NotebookRun


def execute(run):
    """Nbmake's result of a chapter: as the build executed it, or executed now for the build too."""
    from book._ext.execute import execute_cached

    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VMC_RENDER_MODE", "book")
        patch.delenv("MPLBACKEND", raising=False)
        notebook, _, error = execute_cached(Path(run.filename), run.default_timeout)
    return NotebookResult(notebook, error and NotebookError(error, error, 0))


NotebookRun.execute = execute
