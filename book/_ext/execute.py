"""Chapters are executed side by side, once for the build and for their test, and only where needed.

Which is where a chapter's own lines have changed, or what it imports or reads (its `digest`). One
that raises or writes to stderr has failed: it is executed again, and never published.
"""

import gc
import hashlib
import shutil
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import suppress
from functools import cache
from pathlib import Path
from time import monotonic

import nbformat
from filelock import FileLock
from joblib import cpu_count
from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from jupyter_cache.executors.utils import single_nb_execution
from sphinx.application import ENV_PICKLE_FILENAME
from sphinx.errors import ExtensionError
from sphinx.util import logging

from reproduce.pipeline.imports import DATA_SUFFIXES, imported_files
from vmc_lib.show.prose import CHECK, with_code

ROOMS = ("vmc_lib", "reproduce")  # where any chapter may read data
COUNTED = {"tested": ("tests", "book")}  # pages, and the folders whose code they count
say = logging.getLogger(__name__).info


def setup(app):
    gc.disable()  # it looked through all pages' nodes again and again: a fifth of a build
    app.connect("config-inited", name_cache)
    app.connect("env-get-outdated", execute_what_changed)
    app.connect("build-finished", read_again_what_warned)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def name_cache(app, config):
    """Point MyST-NB to the cache."""
    config.nb_execution_cache_path = str(cache_folder(Path(app.srcdir)))


def cache_folder(root):
    """Where the outputs of the chapters of the book in `root` wait."""
    return root / "_build/.executed"


def digest(page):
    """A name for the state of a chapter's lines and numbers, and of what it imports or reads."""
    root = page.parents[1]
    cells = code_cells(nbformat.read(page, as_version=4).cells)
    code = [cell.source for cell in cells]
    folders = [(root / room, DATA_SUFFIXES) for room in ROOMS]
    folders += [(root / room, {".py", ".ipynb"}) for room in COUNTED.get(page.stem, ())]
    files = {root / "constraints.txt"}.union(*(_files(*folder) for folder in folders))
    with suppress(SyntaxError):  # of which its execution will say where
        files |= imported_files("\n".join([BEFORE, *code]), root)
    states = [f"{file.relative_to(root)} {_content(file)}" for file in sorted(files)]
    names = [cell.id for cell in cells]  # of its demos
    return hashlib.sha256("\n".join([*names, *code, *states]).encode()).hexdigest()[:16]


def code_cells(cells):
    """What is executed of a chapter: its code, and its prose's numbers (see `with_code`)."""
    return [cell for cell in with_code(cells, CHECK) if cell.cell_type == "code"]


def _files(folder, kinds):
    return {file for file in folder.rglob("*") if file.suffix in kinds}


@cache
def _content(file):
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else None


def execute_what_changed(app, env, added, changed, removed):
    """Execute the chapters that the cache does not have, on the cores there are.

    Returns the names of the pages that were read with other outputs.
    """
    names = {Path(env.doc2path(name)): name for name in env.found_docs}
    pages = {page: digest(page) for page in sorted(names) if page.suffix == ".ipynb"}
    cache = open_cache(app.config.nb_execution_cache_path)
    missing = [page for page in pages if not read_stored(cache, page, pages[page])]
    start, failed = monotonic(), []
    with ProcessPoolExecutor(min(cpu_count(), len(missing) or 1)) as pool:
        jobs = {
            pool.submit(execute_cached, page, app.config.nb_execution_timeout): page
            for page in missing
        }
        for done, job in enumerate(as_completed(jobs), start=1):
            page, (_, seconds, error) = jobs[job], job.result()
            left = (monotonic() - start) / done * (len(missing) - done)
            say(
                f"executed {page.stem} in {seconds:.0f} s: {done}/{len(missing)}, {left:.0f} s left"
            )
            if error:
                failed.append(f"{page.name}, {error}")
    if failed:
        message = "\n".join(["These chapters failed:", *failed, REMEDY])
        failures = Path(app.outdir).parent / ".failed"  # which make shows last
        failures.write_text(f"{message}\n", encoding="utf-8")
        raise ExtensionError(message)
    before, env.vmc_digests = getattr(env, "vmc_digests", {}), pages
    return [names[page] for page in pages if before.get(page) != pages[page]]


REMEDY = "Open them with `make lab`, run them to that cell, and mend it or what it imports."


def open_cache(folder):
    """The cache in a folder; anew where its list of chapters is cut, or another program's."""
    try:
        (cache := get_cache(folder)).list_cache_records()
    except Exception as error:  # whatever a reader's disk has made of it
        say(f"{folder} is made anew: it cannot be read ({type(error).__name__})")
        shutil.rmtree(folder)
        cache = get_cache(folder)
    return cache


def read_stored(cache, page, state):
    """A page's notebook with its outputs, whole and of a state (see `digest`), or None."""
    try:
        record = cache.match_cache_notebook(nbformat.read(page, as_version=4))
    except KeyError:
        return None
    try:
        bundle = cache.get_cache_bundle(record.pk)
    except Exception as error:  # as above
        say(f"{page.stem} is executed anew: its outputs are damaged ({type(error).__name__})")
        return None
    return bundle.nb if bundle.record.data.get("digest") == state else None


def execute_cached(page, timeout):
    """A chapter's executed notebook, its seconds, and where and how it failed, or None.

    From the cache, or executed now: the build asks for its pages, and nbmake for its tests.
    """
    folder, state = cache_folder(page.parents[1]), digest(page)
    folder.parent.mkdir(exist_ok=True)
    lock = FileLock(folder.with_suffix(".lock"))
    with lock:
        if notebook := read_stored(open_cache(folder), page, state):
            return notebook, 0, None
    notebook, seconds, error = execute(page, timeout)
    if not error:
        data = {"execution_seconds": seconds, "digest": state}
        with lock:
            store(open_cache(folder), page, notebook, data)
    return notebook, seconds, error


def store(cache, page, notebook, data):
    """Keep a page's outputs, and none of its earlier states."""
    for record in cache.list_cache_records():
        if record.uri == str(page):
            with suppress(KeyError):  # its file has gone
                cache.remove_cache(record.pk)
    bundle = CacheBundleIn(notebook, str(page), data=data)
    cache.cache_notebook_bundle(bundle, check_validity=False, overwrite=True)


# A demo has its cell's name, and is drawn again at the end: a later cell may change what it reads
BEFORE = "from book._ext import drawn_again"
AFTER = "drawn_again.draw_again()"


def execute(page, timeout):
    """The executed notebook, its seconds, and where and how it failed, or None."""
    notebook = nbformat.read(page, as_version=4)
    cells = notebook.cells
    notebook.cells = [*with_code(cells, CHECK), nbformat.v4.new_code_cell(AFTER)]
    record = f"drawn_again.record({[cell.id for cell in code_cells(cells)]})"
    options = {
        "extra_arguments": [
            "--IPKernelApp.log_level=ERROR",  # or it warns that loopback is plain
            f"--IPKernelApp.exec_lines={[BEFORE, record]}",
        ],
        "force_raise_errors": True,  # also where a reader's error does not stop Run All
    }
    result = run(notebook, page.parent, timeout, allow_errors=False, **options)
    error = failure(notebook, result.err)
    notebook.cells = cells
    notebook.metadata.pop("widgets", None)  # their state: no kernel is there to use it
    return notebook, result.time, error


def run(*given, **options):
    """`single_nb_execution`; once more where the kernel died.

    Its ports are chosen before it starts: by then another, started beside it, may have taken one.
    """
    try:
        return single_nb_execution(*given, **options)
    except RuntimeError:  # jupyter_client's where none answers, nbclient's where it dies later
        return single_nb_execution(*given, **options)


def failure(notebook, error):
    """The cell that failed, by its first line, and what it said; None where none did."""
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            at = f"cell {cell.id} (`{cell.source.splitlines()[0]}`)"
            if output.output_type == "error":
                return f"{at}: {output.ename}: {output.evalue}"
            if output.get("name") == "stderr":
                return f"{at} wrote to stderr: {output.text.strip()}"
    return error and f"{type(error).__name__}: {error}"


def read_again_what_warned(app, exception):
    """Forget the pages of a build that warned: the next one, of the same state, warns as well."""
    if app._warncount:
        (Path(app.doctreedir) / ENV_PICKLE_FILENAME).unlink(missing_ok=True)
