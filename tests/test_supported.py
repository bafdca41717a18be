"""Systems for which packages do not exist are named before anything is installed."""

import subprocess
import sys
from pathlib import Path

import pytest

from tools import supported

ROOT = Path(__file__).parents[1]
NONE = ("", "")
DEBIAN = ("glibc", "2.36")


@pytest.mark.parametrize(
    ("system", "machine", "libc"),
    [
        ("Linux", "x86_64", DEBIAN),
        ("Linux", "aarch64", ("glibc", "2.28")),
        ("Darwin", "arm64", NONE),
        ("Windows", "AMD64", NONE),
    ],
)
def test_systems_that_can(system, machine, libc):
    assert supported.problem(system, machine, libc, (3, 14)) is None


@pytest.mark.parametrize(
    ("machine", "words"),
    [
        (("Darwin", "x86_64", NONE, (3, 13)), "Darwin x86_64"),
        (("Windows", "ARM64", NONE, (3, 13)), "Windows ARM64"),
        (("Linux", "x86_64", NONE, (3, 13)), "Linux x86_64 musl"),
        (("Linux", "x86_64", ("glibc", "2.17"), (3, 13)), "glibc 2.17"),
        (("Linux", "riscv64", DEBIAN, (3, 13)), "Linux riscv64"),
        (("FreeBSD", "amd64", NONE, (3, 13)), "FreeBSD"),
        (("Linux", "x86_64", DEBIAN, (3, 10)), "make PYTHON=python3.11"),
        (("Linux", "x86_64", DEBIAN, (3, 11), "PyPy"), "CPython"),
        (("Windows", "AMD64", NONE, (3, 13), "CPython", 32), "64 bits"),
    ],
)
def test_systems_that_cannot_are_told(machine, words):
    assert words in supported.problem(*machine)


def test_it_says_nothing_here_and_needs_no_package():
    command = [sys.executable, "-S", ROOT / "tools/supported.py"]
    assert subprocess.run(command, capture_output=True, check=True).stderr == b""


def test_readme_names_the_systems_and_both_ways_ask_first():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert supported.SYSTEMS in " ".join(readme.split())
    for text in (readme, (ROOT / "Makefile").read_text(encoding="utf-8")):
        assert text.index("tools/supported.py") < text.index("-m venv .venv")
