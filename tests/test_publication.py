"""What a journal asks for: a version, a citation, a paper, guidelines; all of one mind."""

import json
import re
import tomllib
from contextlib import nullcontext
from ctypes import c_int
from pathlib import Path

import pypdfium2
import pypdfium2.raw as pdfium
import pytest
import yaml
from bs4 import BeautifulSoup
from PIL import Image
from pybtex.database import parse_file

from kit import pdf
from tests.pages import book_html
from vmc_lib.show import Slider, demo

ROOT = Path(__file__).parents[1]
VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_bytes())
CODEMETA = json.loads((ROOT / "codemeta.json").read_bytes())
PAPER = (ROOT / "kit/jose/paper.md").read_text(encoding="utf-8")
_, HEAD, BODY = PAPER.split("---\n", 2)
REFERENCES = parse_file(ROOT / "book/references.bib").entries
CHECKLIST = re.findall(
    r"^\| ([^|]+) \| (has|a person) \| (.+) \|$",
    (ROOT / "kit/jose/checklist.md").read_text(encoding="utf-8"),
    re.M,
)


def test_there_is_one_version():
    assert CITATION["version"] == CODEMETA["version"] == VERSION
    assert f"## {VERSION}\n" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


def test_there_is_one_list_of_authors():
    authors = [author["name"] for author in yaml.safe_load(HEAD)["authors"]]
    assert authors == [author["name"] for author in CITATION["authors"]]
    assert authors == [author["name"] for author in CODEMETA["author"]]


def test_the_paper_is_short_and_has_its_sections():
    assert len(BODY.split()) <= 1000
    for part in ("Summary", "Statement of need", "Learning objectives", "Story", "References"):
        assert re.search(rf"^# {part}", BODY, re.M), part


def test_the_paper_cites_known_references():
    cited = set(re.findall(r"@(\w+)", BODY))
    assert cited
    assert cited <= set(REFERENCES)


def test_every_doi_has_the_form_of_one():
    dois = [entry.fields["doi"] for entry in REFERENCES.values() if "doi" in entry.fields]
    assert dois
    assert all(re.fullmatch(r"10\.\d{4,9}/\S+", doi) for doi in dois), dois


def test_every_reference_can_be_opened():
    closed = {name for name, entry in REFERENCES.items() if not {"doi", "url"} & {*entry.fields}}
    assert not closed
    addresses = [entry.fields["url"] for entry in REFERENCES.values() if "url" in entry.fields]
    assert all(re.fullmatch(r"https?://\S+\.\S+/\S+", address) for address in addresses), addresses


def test_the_files_of_the_checklist_exist():
    assert CHECKLIST
    for _, _, places in CHECKLIST:
        files = re.findall(r"`([\w./-]+)`", places)
        assert files
        assert all((ROOT / file).is_file() for file in files), files


def test_windows_installs_the_same_as_make():
    """README's lines of PowerShell, and the Makefile's: pip gets the same arguments in both."""
    arguments = {
        file: re.findall(
            r"(?:pip install|call pip,\$\(1\)\)) (?:--quiet )?(.* -r .*)",
            (ROOT / file).read_text(encoding="utf-8"),
        )
        for file in ("README.md", "Makefile")
    }
    assert len(arguments["README.md"]) == 2
    assert arguments["README.md"] == arguments["Makefile"][:2]


def test_the_readme_has_a_small_picture_that_moves():
    """A picture that is quick to load, and that comes to rest."""
    [image] = re.findall(r"!\[[^]]+\]\(([^)]+)\)", (ROOT / "README.md").read_text(encoding="utf-8"))
    assert (ROOT / image).stat().st_size < 1.5e6
    with Image.open(ROOT / image) as picture:
        assert picture.n_frames > 1
        assert picture.info["loop"] > 0  # 0 is for ever


# ---------------------------------------------------------------- on paper


def test_every_page_is_printed_once():
    names = pdf.names()
    assert len(set(names)) == len(names)
    pages = [path for kind in ("ipynb", "md") for path in (ROOT / "book").rglob(f"*.{kind}")]
    kept = {path.with_suffix("") for path in pages if ".ipynb_checkpoints" not in path.parts}
    assert {ROOT / name for name in names} == kept  # JupyterLab's own copies are no pages


@pytest.mark.audit
@pytest.mark.browser
def test_pages_are_printed_as_one_book(chromium, tmp_path):
    """Numbered, with bookmarks and links inside; each demo in two positions, and nothing folded."""
    names = ["book/01_loop", "book/07_muscle", "book/glossary"]
    pdf.print_book(chromium, ROOT / "_build/html", names, tmp_path / "book.pdf")
    with pypdfium2.PdfDocument(tmp_path / "book.pdf") as book:
        titles = [mark.get_title() for mark in book.get_toc()]
        assert "From excitation to activation" in titles
        assert "Glossary" in titles
        assert not {*titles} - {title for name in names for title in _headings(name)}
        texts = [page.get_textpage().get_text_bounded().split() for page in book]
        for number, words in enumerate(texts, start=1):
            assert words[-1] == str(number)
        words = [word for page in texts for word in page]
        assert not [word for word in words if word.startswith("explore(")]
        assert len(re.findall(r"pulses a second (\d+)", " ".join(words))) == 2
        moments = re.findall(r"time (\d\.\d\d) s", " ".join(words))
        assert moments
        assert "0.00" not in moments
        assert sum(map(_links_inside, book)) > 10


STILL = (ROOT / "kit/still.js").read_text(encoding="utf-8")


@pytest.mark.browser
def test_paper_shows_a_demo_where_its_author_says(open_page):
    def show(**more):
        controls = {"x": Slider([1, 2, 3], "x"), "way": ["left", "right"]}
        words = "<p>{} {}</p>".format
        demo.explore(lambda x, way: words(x, way), "c", "a", **controls, **more)

    def declare():
        show()
        show(printed=[{"x": 3}, {"way": "right", "x": 2}, {}])

    page = open_page(f"<article>{book_html(demo, declare)}</article>")
    still = page.evaluate(STILL, "file:///")
    printed = ["1 left", "3 left", "3 left", "2 right", "1 left"]
    assert re.findall(r"<p>(\d \w+)</p>", still) == printed


@pytest.mark.browser
def test_links_hold_on_paper_wherever_the_book_lies(chromium, tmp_path):
    html = tmp_path / "a b&c#d+ü"
    html.mkdir()
    for name, other in (("one", "two"), ("two", "one")):
        page = f'<article><h1 id="top">{name}</h1><a href="{other}.html#top">{other}</a>'
        page += '<p class="unseen">Unseen</p><a class="vmc-link" href="#x">#</a></article>'
        head = f'<title>A book</title><link rel="stylesheet" href="{name}.css">'
        (html / f"{name}.html").write_text(head + page, encoding="utf-8")
        (html / f"{name}.css").write_text("", encoding="utf-8")
    (html / "two.css").write_text(".unseen { display: none; }", encoding="utf-8")
    key = html / "key.html"
    key.write_text("<h2>one</h2><p>It is 7.</p>", encoding="utf-8")
    pdf.print_book(chromium, html, ["one", "two"], tmp_path / "book.pdf", key)
    with pypdfium2.PdfDocument(tmp_path / "book.pdf") as book:
        assert sum(map(_links_inside, book)) == 2
        texts = [page.get_textpage().get_text_bounded() for page in book]
        assert "It is 7." in texts[-1]
        assert not re.findall("Unseen|#", " ".join(texts))


def test_the_pdf_has_the_key_and_leaves_the_kit_as_it_was(tmp_path, monkeypatch):
    keys, picture = [], tmp_path / "_build/kit/figures/figure-2-1.png"
    picture.parent.mkdir(parents=True)
    picture.touch()
    monkeypatch.setattr(pdf, "ROOT", tmp_path)
    monkeypatch.setattr(pdf, "names", list)
    monkeypatch.setattr(pdf.browser, "launch", nullcontext)
    monkeypatch.setattr(pdf, "write_texts", lambda folder, _: (folder / "key.html").touch())
    monkeypatch.setattr(pdf, "print_book", lambda *given: keys.append(given[-1].exists()))
    pdf.main()
    assert keys == [True]
    assert picture.exists()


def _headings(name):
    page = BeautifulSoup(
        (ROOT / f"_build/html/{name}.html").read_text(encoding="utf-8"), "html.parser"
    )
    return [heading.get_text().removesuffix("#") for heading in page.select("h1, h2, h3")]


def _links_inside(page):
    """How many links of a page lead to a place in the same document."""
    place, link, inside = c_int(0), pdfium.FPDF_LINK(), 0
    while pdfium.FPDFLink_Enumerate(page, place, link):
        inside += bool(pdfium.FPDFLink_GetDest(page.pdf, link))
    return inside
