"""Remake all that ships: `python -m reproduce`. What is up to date is left as it is."""

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from reproduce.pipeline import smoke_run
from reproduce.pipeline.progress import run_tasks
from reproduce.pipeline.steps import ROOT, STEPS, describe_steps, tasks


def main(arguments=None):
    """Run what the command line asks for, and return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m reproduce", description=__doc__)
    choice = parser.add_mutually_exclusive_group()
    choice.add_argument("--list", action="store_true", help="say what every step makes, and stop")
    names = [step.name for step in STEPS]
    choice.add_argument(
        "--only", metavar="STEP", choices=names, help="this step, up to date or not"
    )
    choice.add_argument("--smoke", action="store_true", help="every step at toy size, for nothing")
    options = parser.parse_args(arguments)
    if options.list:
        print(*describe_steps(), sep="\n")
        return 0
    if options.smoke:
        with TemporaryDirectory() as folder:
            return smoke_run.run_all(Path(folder))
    if options.only:
        return run_tasks(tasks(), [options.only], ROOT, "--single", "--always-execute")
    return run_tasks(tasks(), [step.name for step in STEPS if not step.needs], ROOT)


if __name__ == "__main__":  # pragma: no cover: the tests call `main`
    sys.exit(main())
