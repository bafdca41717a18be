"""The book itself: seconds to build it from clean, and what its pages weigh."""

import subprocess
from pathlib import Path
from time import perf_counter

from tools.bench.report import publish

PAGES = "_build/html"


def build():
    """Seconds of a clean, strict build of the book."""
    start = perf_counter()
    subprocess.run(["make", "clean", "book"], check=True, capture_output=True)
    return perf_counter() - start


def weights(root):
    """MB of the whole book, of its scripts and of its heaviest chapter."""
    files = {p: p.stat().st_size / 1e6 for p in Path(root).rglob("*") if p.is_file()}
    chapters = {p: size for p, size in files.items() if p.match("book/[0-9]*.html")}
    heaviest = max(chapters, key=chapters.get)
    scripts = sum(size for p, size in files.items() if "vendor" in p.parts)
    return {
        "the whole book (MB)": sum(files.values()),
        "scripts it brings along (MB)": scripts,
        f"heaviest chapter, {heaviest.stem} (MB)": chapters[heaviest],
    }


if __name__ == "__main__":
    measured = {"clean build (s)": build(), **weights(PAGES)}
    publish("book", [{"what": name, "value": round(v, 1)} for name, v in measured.items()])
