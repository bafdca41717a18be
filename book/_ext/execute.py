"""Chapters are executed side by side, and only those that changed or whose library did.

One that raises or writes to stderr has failed: it is executed again, and never published.

The outputs wait in a cache whose folder is named after everything that a chapter can import: when
one line of that changes, the folder is another one, and empty.
"""

import gc
import hashlib
import shutil
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from time import monotonic

import nbformat
from joblib import cpu_count
from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from jupyter_cache.executors.utils import single_nb_execution
from sphinx.application import ENV_PICKLE_FILENAME
from sphinx.errors import ExtensionError
from sphinx.util import logging

READ_BY_CHAPTERS = (
    *("vmc_lib", "arm_in_page", "eye_in_page", "reproduce", "render", "tests"),
    *("book/figures", "book/exercises"),
)
say = logging.getLogger(__name__).info


def setup(app):
    gc.disable()  # it looked through all pages' nodes again and again: a fifth of a build
    app.connect("config-inited", name_cache)
    app.connect("env-before-read-docs", execute_what_changed)
    app.connect("build-finished", read_again_what_warned)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def digest(root):
    """A name for the state of all files under `root` that a chapter can import or read."""
    files = (f for top in READ_BY_CHAPTERS for f in sorted((root / top).rglob("*")) if f.is_file())
    summed = hashlib.sha256()
    for file in (root / "constraints.txt", *files):
        if file.exists() and "__pycache__" not in file.parts:
            summed.update(f"{file.relative_to(root)}\n".encode() + file.read_bytes())
    return summed.hexdigest()[:16]


def name_cache(app, config):
    """Point MyST-NB to the cache of this state of the library; those of other states go."""
    caches = Path(app.outdir).parent / ".executed"
    here = caches / digest(Path(app.srcdir))
    for other in set(caches.glob("*")) - {here}:
        shutil.rmtree(other, ignore_errors=True)
    config.nb_execution_cache_path = str(here)


def execute_what_changed(app, env, names):
    """Execute the chapters that the cache does not have, on the cores there are."""
    cache = open_cache(app.config.nb_execution_cache_path)
    pages = (Path(env.doc2path(name)) for name in env.found_docs)
    missing = [page for page in sorted(pages) if page.suffix == ".ipynb" and not known(cache, page)]
    if not missing:
        return
    start, failed = monotonic(), []
    with ProcessPoolExecutor(min(cpu_count(), len(missing))) as pool:
        jobs = {
            pool.submit(execute, page, app.config.nb_execution_timeout): page for page in missing
        }
        for done, job in enumerate(as_completed(jobs), start=1):
            page, (notebook, seconds, error) = jobs[job], job.result()
            left = (monotonic() - start) / done * (len(missing) - done)
            say(
                f"executed {page.stem} in {seconds:.0f} s: {done}/{len(missing)}, {left:.0f} s left"
            )
            if error:
                failed.append(f"{page.name}, {error}")
            else:
                bundle = CacheBundleIn(notebook, page, data={"execution_seconds": seconds})
                cache.cache_notebook_bundle(bundle, check_validity=False, overwrite=True)
    if failed:
        message = "\n".join(["These chapters failed:", *failed, REMEDY])
        failures = Path(app.outdir).parent / ".failed"  # which make shows last
        failures.write_text(f"{message}\n", encoding="utf-8")
        raise ExtensionError(message)


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


def known(cache, page):
    """Whether the cache has a page's outputs, whole."""
    try:
        record = cache.match_cache_notebook(nbformat.read(page, as_version=4))
    except KeyError:
        return False
    try:
        cache.get_cache_bundle(record.pk)
    except Exception as error:  # as above
        say(f"{page.stem} is executed anew: its outputs are damaged ({type(error).__name__})")
        return False
    return True


def execute(page, timeout):
    """The executed notebook, its seconds, and where and how it failed, or None."""
    notebook = nbformat.read(page, as_version=4)
    options = {
        "extra_arguments": ["--IPKernelApp.log_level=ERROR"],  # or it warns that loopback is plain
        "force_raise_errors": True,  # also where a reader's error does not stop Run All
    }
    result = single_nb_execution(notebook, page.parent, timeout, allow_errors=False, **options)
    return notebook, result.time, failure(notebook, result.err)


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
