"""Run steps by doit, which leaves out what is up to date, with a line of progress each."""

import json
import os
from pathlib import Path
from time import perf_counter

from doit.cmd_base import ModuleTaskLoader
from doit.doit_cmd import DoitMain
from doit.reporter import ConsoleReporter


class Progress(ConsoleReporter):
    """A line a step: its name, and how long it took."""

    def execute_task(self, task):
        """A step begins."""
        self.begun = perf_counter()
        print(task.name, end=" … ", flush=True)

    def add_success(self, task):
        """It is done."""
        print(f"{perf_counter() - self.begun:.0f} s", flush=True)

    def skip_uptodate(self, task):
        """Nothing that it reads has changed."""
        print(f"{task.name}: up to date", flush=True)


def run_tasks(tasks, names, folder, *options):
    """Run those of doit's `tasks` that are named, and return the exit status: 0 is good.

    What they read and made is remembered in `folder`, to know what is up to date; a memory that is
    damaged is made anew.
    """
    if not os.access(folder, os.W_OK):
        print(f"{folder} cannot be written: there is no place for what is remade")
        return 1
    memory = Path(folder, ".doit.json")
    try:
        dict(json.loads(memory.read_bytes()) if memory.exists() else {})
    except (ValueError, TypeError):
        print(f"{memory} is damaged, and made anew: no step counts as up to date")
        memory.unlink()
    config = {"dep_file": str(memory), "backend": "json", "reporter": Progress}
    namespace = {"DOIT_CONFIG": config, "task_steps": lambda: (task for task in tasks)}
    return DoitMain(ModuleTaskLoader(namespace)).run(["run", *options, *names])
