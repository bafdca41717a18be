"""The page's Python: seconds from a reader's click to what is said of the lines.

make book, then .venv/bin/python -m bench.python_in_page   (a browser; an idle machine tells most)
"""

import inspect
from pathlib import Path
from time import perf_counter

from bench.report import publish
from book.exercises.muscle import activation_rates
from tools import browser

CHAPTER = Path(__file__).parents[1] / "_build/html/book/07_muscle.html"
WRITE = "(lines) => (document.querySelector('.vmc-lines').value = lines)"  # it starts no Python
PAGES, LATER = 3, 10  # opened for a first verdict; later ones in one of them


def verdicts(chromium, count):
    """Seconds of `count` verdicts, one after the other, in a page that is opened for them."""
    page = chromium.new_context(offline=True).new_page()
    page.goto(CHAPTER.as_uri())
    form = page.locator("form[data-function]").first
    page.evaluate(WRITE, inspect.getsource(activation_rates))
    for _ in range(count):
        form.evaluate("(form) => form.querySelector('[role=status]').replaceChildren()")
        began = perf_counter()
        form.get_by_role("button", name="Check").click()
        form.get_by_text("✓ Right.").wait_for()
        yield perf_counter() - began
    page.close()


def main():
    """Measure the first verdict in pages just opened, and later ones in one of them."""
    with browser.launch() as chromium:
        first = [next(verdicts(chromium, 1)) for _ in range(PAGES)]
        _, *later = verdicts(chromium, 1 + LATER)
    rows = {"first": min(first), "later": min(later)}
    publish("python_in_page", [{"verdict": k, "s": round(s, 2)} for k, s in rows.items()])


if __name__ == "__main__":
    main()
