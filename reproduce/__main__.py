"""Remake all that ships: `python -m reproduce`. What is up to date is left as it is."""

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from reproduce.pipeline import smoke_run
from reproduce.pipeline.progress import run
from reproduce.pipeline.steps import ROOT, STEPS, listed, tasks


def main(arguments=None):
    """Run what the command line asks for, and return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m reproduce", description=__doc__)
    asked = parser.add_mutually_exclusive_group()
    asked.add_argument("--list", action="store_true", help="say what every step makes, and stop")
    names = [step.name for step in STEPS]
    asked.add_argument("--only", metavar="STEP", choices=names, help="this step, up to date or not")
    asked.add_argument("--smoke", action="store_true", help="every step at toy size, for nothing")
    given = parser.parse_args(arguments)
    if given.list:
        print(*listed(), sep="\n")
        return 0
    if given.smoke:
        with TemporaryDirectory() as folder:
            return smoke_run.run_all(Path(folder))
    if given.only:
        return run(tasks(), [given.only], ROOT, "--single", "--always-execute")
    return run(tasks(), [step.name for step in STEPS if not step.needs], ROOT)


if __name__ == "__main__":  # pragma: no cover: the tests call `main`
    sys.exit(main())
