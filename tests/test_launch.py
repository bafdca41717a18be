"""The buttons that open a chapter elsewhere, or save it: a book of one page, built."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[1]
CHAPTER = nbformat.v4.new_notebook(
    cells=[nbformat.v4.new_markdown_cell("# A chapter", id="title")],
    metadata={"kernelspec": {"name": "python3", "display_name": "Python 3"}},
)


@pytest.fixture
def links(tmp_path, monkeypatch):
    """A function that builds the book for a repository and returns the page's links."""
    shutil.copy(ROOT / "_config.yml", tmp_path)
    (tmp_path / "_toc.yml").write_text("format: jb-book\nroot: book/chapter\n", encoding="utf-8")
    shutil.copytree(ROOT / "book/_ext", tmp_path / "book/_ext")
    for folder in ("book/_static", "vmc_lib", "arm_in_page"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    (tmp_path / "book/references.bib").touch()
    nbformat.write(CHAPTER, tmp_path / "book/chapter.ipynb")

    def links(**told):
        environment = {k: v for k, v in os.environ.items() if not k.startswith("GITHUB_")} | told
        command = [Path(sys.executable).with_name("jupyter-book"), "build", "-W", "-n", "."]
        subprocess.run(command, cwd=tmp_path, env=environment, check=True, capture_output=True)
        page = (tmp_path / "_build/html/book/chapter.html").read_text(encoding="utf-8")
        return re.findall(r'href="([^"]+)"', page)

    return links


def test_without_an_address_a_chapter_can_be_saved_but_nothing_leads_out(links):
    found = links()
    assert "../_sources/book/chapter.ipynb" in found
    assert not [link for link in found if link.startswith("http")]


def test_with_an_address_a_chapter_opens_on_binder_and_colab(links):
    told = {"GITHUB_SERVER_URL": "https://github.com", "GITHUB_REPOSITORY": "owner/name"}
    out = [link for link in links(**told) if link.startswith("http")]
    assert out == [
        "https://mybinder.org/v2/gh/owner/name/main?urlpath=lab/tree/book/chapter.ipynb",
        "https://colab.research.google.com/github/owner/name/blob/main/book/chapter.ipynb",
    ]
