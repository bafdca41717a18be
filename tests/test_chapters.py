"""The chapters: complete, tidy, in the table of contents, and each runs from top to bottom."""

import ast
import re
import symtable
from itertools import chain

import nbformat
import pytest
import yaml
from ipykernel.ipkernel import IPythonKernel
from ipykernel.kernelspec import get_kernel_dict
from pybtex.database import parse_file
from pybtex.richtext import Text

from book._ext.plain import FOLD, PREDICTION, TERMS
from book.figures.inventory import DEMO
from tests.project import CHAPTERS, NOTEBOOKS, ROOT, code, each_chapter, python
from vmc_lib.show.prose import COMMENT, NUMBER


@pytest.fixture(params=NOTEBOOKS, ids=lambda path: path.stem)
def notebook(request):
    return nbformat.read(request.param, as_version=4)


def sources(notebook, kind="code"):
    """The text of each cell of a kind."""
    return [cell.source for cell in notebook.cells if cell.cell_type == kind]


def tagged(cell, *tags):
    return {*tags} & {*cell.metadata.get("tags", [])}


def test_no_widget_captures_output(notebook):
    """The client that builds the book answers such a widget, and may then miss the cell's reply."""
    cells = "\n".join(sources(notebook))
    assert not re.search(r"\b(interactive_output|interact|Output)\(", cells)


def test_no_cell_rebinds_what_an_earlier_function_reads(notebook):
    """Or a demo above it would fail, or show another thing, as soon as it is moved.

    A law that is verified may take the library's place: the demos above it follow the reader's.
    """
    bound, read = set(), set()
    for cell in notebook.cells:
        if cell.cell_type == "code":
            names = symtable.symtable(cell.source, cell.id, "exec")
            here = {
                name.get_name()
                for name in names.get_symbols()
                if name.is_assigned() or name.is_imported()
            }
            laws = {scope.get_name() for scope in names.get_children()} if is_core(cell) else set()
            assert not (here - laws) & read, cell.id
            bound |= here
            read |= bound & read_by_functions(names)


COMPREHENSIONS = {"listcomp", "setcomp", "dictcomp", "genexpr"}  # they read at once


def read_by_functions(scope, called_later=False):
    """The notebook's names that functions and lambdas in a scope read."""
    called_later |= scope.get_type() == "function" and scope.get_name() not in COMPREHENSIONS
    names = {name.get_name() for name in scope.get_symbols() if called_later and name.is_global()}
    return names.union(*(read_by_functions(inner, called_later) for inner in scope.get_children()))


def test_every_page_is_in_the_table_of_contents():
    toc = yaml.safe_load((ROOT / "_toc.yml").read_bytes())
    entries = {toc["root"]} | {page["file"] for part in toc["parts"] for page in part["chapters"]}
    pages = {*NOTEBOOKS, *(ROOT / "book").glob("*.md")}
    assert entries == {f"book/{path.stem}" for path in pages}


def test_the_front_page_leads_to_every_chapter_in_order():
    front = nbformat.read(ROOT / "book/index.ipynb", as_version=4)
    front = "\n".join(sources(front, "markdown"))
    links = re.findall(r"^\d+\. \[[^]]+\]\((\w+)\.ipynb\)$", front, re.M)
    assert links == [path.stem for path in CHAPTERS]


def test_sources_are_named_in_prose(notebook):
    """The page makes its own links of them there; in what a cell prints they would lead nowhere."""
    assert not re.search(r"references\.bib|glossary\.md", "\n".join(sources(notebook)))
    prose = "\n".join(sources(notebook, "markdown"))
    source = r"\[[^\]]+\]\(references\.bib#\w+\)"
    assert "references.bib" not in re.sub(rf"\({source}(?:, {source})*\)", "", prose)


def test_is_stored_without_outputs(notebook):
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert code
    assert not any(cell.outputs or cell.execution_count for cell in code)


def test_cells_are_short_enough_to_read(notebook):
    """At most 15 lines; a chapter's mechanism, open and held to the library, up to 25."""
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert len(cell.source.splitlines()) <= (25 if is_core(cell) else 15), cell.id


def is_core(cell):
    """A mechanism in the open, which the reader sees verified against the library."""
    return is_open(cell) and re.search(r"^verify\(", cell.source, re.M)


def is_open(cell):
    """Code that the page shows unfolded."""
    return not {*cell.metadata.get("tags", [])} - {"runs-in-page"}


def test_starts_with_one_title(notebook):
    assert notebook.cells[0].cell_type == "markdown"
    assert notebook.cells[0].source.startswith("# ")
    assert len(re.findall(r"^# ", "\n".join(sources(notebook, "markdown")), re.M)) == 1


@each_chapter
def test_a_chapter_teaches(path):
    """A demo, aims and minutes; questions; a checked exercise, its solution; quiz; recap."""
    notebook = nbformat.read(path, as_version=4)
    text, source = "\n".join(sources(notebook, "markdown")), code(path)
    aims = next(i for i, cell in enumerate(notebook.cells) if "be able to" in cell.source)
    assert re.search(r"\d+\s+minutes", notebook.cells[aims].source)
    first = next(i for i, cell in enumerate(notebook.cells) if DEMO.search(cell.source))
    assert first < aims < first + 5  # something to move, its caption, perhaps a question
    assert "**Predict.** " in text
    assert "Predict first" not in text  # a box that nothing closes
    assert re.search(r"^\*\*Exercise(: .+)?\*\*$", text, re.M)
    assert any(tagged(cell, "solution") for cell in notebook.cells)
    assert len(re.findall(r"\b(check|grade|solution)\(", source)) >= 2  # to answer, and solved
    assert 2 <= len(re.findall(r"^\*\*Quiz\.\*\* ", text, re.M)) <= 3
    assert re.search(r"^## Recap$", text, re.M)
    assert "](glossary.md" in text


def test_a_prediction_is_closed_by_the_run(notebook):
    """What came out is a condition on what the notebook works out: on no name of a mere text."""
    nodes = list(ast.walk(ast.parse("\n".join(sources(notebook)))))
    assigned = [node for node in nodes if isinstance(node, ast.Assign)]
    literals = [node for node in assigned if isinstance(node.value, ast.Constant)]
    typed = {name for node in literals for target in node.targets for name in names_in(target)}
    for text in sources(notebook, "markdown"):
        if text.startswith("**Predict"):
            assert PREDICTION.fullmatch(COMMENT.sub("", text)), text
            condition = re.search(r"^\*\*.+\.\*\*<!--\{(.+?)\}-->", text, re.M)[1]
            assert names_in(ast.parse(condition)) - typed - {"nearest"}, text


def test_every_import_is_used_in_code_or_prose(notebook):
    trees = [ast.parse(source) for source in sources(notebook)]
    prose = "\n".join(sources(notebook, "markdown"))
    numbers = [ast.parse(number["value"]) for number in NUMBER.finditer(prose)]
    imports = (n for t in trees for n in ast.walk(t) if isinstance(n, ast.Import | ast.ImportFrom))
    imported = {(one.asname or one.name).split(".")[0] for n in imports for one in n.names}
    assert imported <= {*chain.from_iterable(map(names_in, [*trees, *numbers]))}


@each_chapter
def test_captions_and_predictions_are_prose(path):
    """No words of the main line in a string: a notebook that has not run shows them too."""
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "code" and not tagged(cell, "solution"):
            calls = (n for n in ast.walk(ast.parse(cell.source)) if isinstance(n, ast.Call))
            assert not [c for c in calls if any(k.arg == "caption" for k in c.keywords)], cell.id


OWN_WORDS = {  # plots, which tell their data; and what the page itself describes
    *("recall-at-overlap", "2dc490-f", "table-1", "table-2", "fresh-d", "shifted-crop"),
    "suppression-d",
}


@pytest.mark.parametrize("stem", ["02_candidates", "03_regions", "05_hierarchy"])
def test_a_picture_that_is_no_plot_is_described(stem):
    """Its own words would be the labels that are written in it, and not what is seen."""
    silent = set()
    for cell in nbformat.read(ROOT / f"book/{stem}.ipynb", as_version=4).cells:
        tree = ast.parse(cell.source if cell.cell_type == "code" else "")
        calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
        shown = [call for call in calls if names_in(call.func) & {"explore", "figure"}]
        silent |= {cell.id for call in shown if not any(k.arg == "alt" for k in call.keywords)}
    assert silent <= OWN_WORDS


def names_in(tree):
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}


def test_markdown_needs_no_roles_or_directives(notebook):
    """A notebook elsewhere would show them raw: chapters are plain (book/_ext/plain.py)."""
    text = "\n".join(sources(notebook, "markdown"))
    assert not re.findall(r"(?<!`)\{[a-z-]+\}`[^`]+`", text)
    assert not re.findall(r"^ *(?:`{3,}|:{3,})\{.*", text, re.M)
    cited = re.findall(r"[(, ]\[([^\]]+)\]\(references\.bib#(\w+)\)[),]", text)
    assert len(cited) == text.count("references.bib")
    entries = parse_file(ROOT / "book/references.bib").entries
    assert [name for name, _ in cited] == [author_year(entries[key]) for _, key in cited]


def author_year(entry):
    """How a source is called in a sentence: by its first two authors, and its year."""
    authors = [" ".join(p.prelast_names + p.last_names) for p in entry.persons["author"]]
    names = [str(Text.from_latex(author)) for author in authors]
    several = len(names) > 2 or "others" in names
    return f"{names[0] + ' et al.' if several else ' and '.join(names)} {entry.fields['year']}"


def test_code_that_only_draws_is_folded_in_a_notebook_too(notebook):
    for cell in notebook.cells:
        if tagged(cell, "hide-input", "remove-input"):
            assert cell.metadata.jupyter.source_hidden


def test_answers_fold_by_themselves(notebook):
    """JupyterLab unfolds text and outputs that a notebook only calls hidden, when it runs them."""
    for cell in notebook.cells:
        hidden = cell.metadata.get("jupyter", {})
        assert "outputs_hidden" not in hidden
        if cell.cell_type == "markdown":
            assert not hidden
            assert cell.source.count("<details>") == cell.source.count("</details>")
            assert not tagged(cell, "solution") or FOLD.fullmatch(cell.source)
        elif tagged(cell, "solution"):  # its code is folded, and what it shows
            assert hidden.source_hidden
            assert not re.search(r"\b(check|grade|markdown|figure|explore|print)\(", cell.source)


@each_chapter
def test_a_notebook_says_how_to_run_it(path):
    """At its top, in the words of all the others; the page has no need of it."""
    first, *others = (nbformat.read(path, as_version=4).cells[1] for path in (CHAPTERS[0], path))
    assert "Run All Cells" in first.source
    assert "No module named" in first.source  # as without the clone around it, in Colab say
    assert tagged(first, "remove-cell")
    assert others == [first]


def test_a_readers_error_does_not_stop_run_all(notebook):
    """From an exercise to its solution all may raise that is the reader's, or reads it."""
    unsolved = False
    for cell in notebook.cells:
        unsolved = ("exercise" in cell.metadata or unsolved) and not tagged(cell, "solution")
        if cell.cell_type == "code":
            may = unsolved and not tagged(cell, "hide-input")
            assert bool(tagged(cell, "raises-exception")) == may, cell.id


def test_opening_a_notebook_does_not_change_it(notebook):
    """JupyterLab writes what the kernel says of itself; ours keep Python's own number to themselves
    (.binder/ipython_kernel_config.py)."""
    language = {k: v for k, v in IPythonKernel.language_info.items() if k != "version"}
    spec = get_kernel_dict() | {"name": "python3"}
    kernel = {key: spec[key] for key in ("display_name", "language", "name")}
    assert notebook.metadata == {"kernelspec": kernel, "language_info": language}


def test_links_to_the_glossary_lead_to_a_term(notebook):
    text = "\n".join(cell.source for cell in notebook.cells)
    terms = re.findall(r"\]\(glossary\.md([^)]*)\)", text)
    assert {term.removeprefix("#") for term in terms} <= TERMS.keys()


def test_code_is_as_wide_as_the_page():
    """No line of a chapter's code is cut off at the page's edge: 79 columns."""
    assert [path.stem for path in CHAPTERS if max(map(len, code(path).splitlines())) > 79] == []
    python("-m", "ruff", "format", "--check", "--line-length", "79", *CHAPTERS)


def test_a_mechanism_is_verified_by_its_cells_last_line(notebook):
    """Once: what is said of it names the functions of its cell that the reader has changed."""
    for cell in notebook.cells:
        if cell.cell_type == "code" and ("verify(" in cell.source or tagged(cell, "runs-in-page")):
            if not tagged(cell, "raises-exception"):  # an exercise
                calls = re.findall(r"^ *verify\(", cell.source, re.M)
                assert len(calls) == 1, cell.id


@each_chapter
def test_open_code_is_the_mechanism(path):
    """One or two open cells, each verified; no more than 5 % of other open code."""
    cells = nbformat.read(path, as_version=4).cells
    code = [cell for cell in cells if cell.cell_type == "code" and is_open(cell)]
    lines = {cell.id: len(cell.source.splitlines()) for cell in code}
    core = [cell.id for cell in code if is_core(cell)]
    assert len(core) in (1, 2)
    assert all(8 <= lines[name] <= 25 for name in core)
    rest = sum(lines[name] for name in lines.keys() - {*core})
    assert rest <= 0.05 * sum(lines.values())
