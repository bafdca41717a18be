"""The browser keeps its sandbox wherever it starts in one."""

import pytest

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
