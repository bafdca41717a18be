"""The browser keeps its sandbox wherever it starts in one."""

import os
import subprocess
import sys

import pytest

from tests.project import ROOT
from tools import browser


@pytest.mark.parametrize("refusal", [0, 1])
def test_sandbox_is_off_only_where_the_browser_refuses_it(tmp_path, refusal):
    program = tmp_path / "chromium"
    program.write_text(f"#!/bin/sh\nexit {refusal}\n", encoding="utf-8")
    program.chmod(0o755)
    options = browser.options(str(program))
    assert options["chromium_sandbox"] == (refusal == 0)
    assert "--no-sandbox" not in options["args"]


@pytest.mark.browser
def test_browser_starts_with_our_options(chromium):
    assert chromium.is_connected()


@pytest.mark.audit
@pytest.mark.parametrize("workers", ["0", "1"])
def test_the_last_lines_say_what_was_not_tested(tmp_path, workers):
    """Where there is no browser, of the system or of Playwright."""
    kept = {name: x for name, x in os.environ.items() if not name.startswith(("CI", "PYTEST"))}
    nowhere = {"PATH": str(tmp_path), "PLAYWRIGHT_BROWSERS_PATH": str(tmp_path)}
    tests = "tests/test_browser.py", "-k", "starts_with_our", "-n", workers
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *tests]
    done = subprocess.run(
        command, cwd=ROOT, env=kept | nowhere, capture_output=True, encoding="utf-8"
    )
    assert done.returncode == 0, done.stdout
    last = done.stdout.splitlines()[-1]
    assert last == f"NOT TESTED: 1 of the tests. Skipped: {browser.MISSING}"
