"""The steps that remake all that ships: what each makes, from what, and about how long it takes."""

import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from inspect import getsourcefile
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from joblib import parallel_config
from joblib.externals.loky import get_reusable_executor

from reproduce import ledger, results
from reproduce.experiments import (
    calibration,
    cdbn_sensitivity,
    class_independence,
    controller_comparison,
    crbm_ablation,
    domain_shift,
    eye_ablation,
    feedback_control,
    forgetting_adaptation,
    fresh_test_set,
    hmax_draws,
    learning_curves,
    learning_under_noise,
    localisation,
    loop_evaluation,
    muscle_weakness,
    nulls,
    other_filters,
    pasted_scenes,
    printed_sheet,
    random_filters,
    real_world,
    recognition,
    region_clusters,
    rival_controllers,
    second_layers,
    sensitivity,
    stream_ablation,
)
from reproduce.peers import minimum_variance, optimal_control
from reproduce.pipeline import checksums
from reproduce.pipeline.imports import DATA_SUFFIXES, imported_files
from reproduce.render import bone_meshes, cutout_atlas
from reproduce.training import arm_tables, shipped_models, ventral_stream
from reproduce.whole_arm import bones as bones63
from reproduce.whole_arm import experiment, habits, plant
from vmc_lib import data

ROOT, DATA_FOLDER, RESULTS = Path(__file__).parents[2], data.FOLDER, results.FOLDER
FRESH = ROOT / "_build/fresh_photos"  # of tests to come: they do not ship
ELSEWHERE = ROOT / "_build/elsewhere_photos"  # likewise


@dataclass(frozen=True)
class Step:
    """One file, or one folder, and how it is made."""

    make: Callable | str  # gives what the file holds; or a command that writes it
    file: Path
    reads: str = ""  # the steps whose files it reads, and folders that hold more of such
    minutes: float = 1  # about, on two cores
    needs: str = ""  # what not every machine has: such a step runs only when it is asked for

    @property
    def name(self):
        """What the step is called, as its file."""
        return self.file.stem

    @property
    def function(self):
        """The function that makes it, without what it is given."""
        return getattr(self.make, "func", self.make)

    def inputs(self):
        """Every file that the step depends on: what it reads, and the code that it can run.

        ValueError where it reads neither a step's file nor one that is there.
        """
        makes = {step.name: step.file for step in STEPS}
        places = {name: makes.get(name, ROOT / name) for name in self.reads.split()}
        if lost := [name for name in places if name not in makes and not places[name].exists()]:
            raise ValueError(f"{self.name} reads {lost}: name steps, or files and folders here")
        within = (file for place in places.values() for file in (place, *place.rglob("*")))
        found = {file for file in within if file.suffix in DATA_SUFFIXES}
        own = Path(getsourcefile(self.function))
        return found | {own} | imported_files(own.read_text(encoding="utf-8"))

    def run(self):
        """Make the file, on all cores, in a new process: one that has read no older file."""
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            pool.submit(_make_file, self).result()


def _make_file(step):
    with parallel_config(n_jobs=-1):
        write(step.file, step.make)
    get_reusable_executor().shutdown()  # idle workers would keep this process for five minutes


def write(file, make):
    """Write what `make()` gives: arrays by name as .npz, or anything plain as .json."""
    content = make()
    if file.suffix == ".npz":
        with results.replacement(file) as new:
            np.savez_compressed(new, **content)
        if file.parent == DATA_FOLDER:
            checksums.write()
    else:
        results.write(file.stem, content, file.parent)


def tasks():
    """The steps as doit's tasks."""
    for step in STEPS:
        if isinstance(step.make, str):
            yield {"basename": step.name, "actions": [step.make, SUMMED]}
        else:
            files = {"file_dep": sorted(step.inputs()), "targets": [step.file]}
            yield {"basename": step.name, "actions": [step.run], **files}


def describe_steps():
    """The steps as lines: name, what is made, minutes, and what else is needed."""
    for step in STEPS:
        needs = f"; needs {step.needs}, so only with --only" if step.needs else ""
        where = step.file.relative_to(ROOT)
        yield f"{step.name:15} {where!s:38} about {step.minutes:g} min{needs}"


PYTHON, MITSUBA = f"{sys.executable} -m", "mitsuba and LLVM 19"
RENDER, OPENSIM = f"{PYTHON} reproduce.render", ".bench/bin/python -m tools.bench.opensim_reference"
SUMMED = f"{PYTHON} reproduce.pipeline.checksums"
TABLES, WHOLE_ARM = "arm26 vmc_lib/arm", "vmc_lib/arm reproduce/whole_arm"
ARM = f"rest {TABLES}"
SHIPPED = "vmc_lib/data vmc_lib/arm"
COUNTEREXAMPLES = "reproduce/training/counterexamples"
PHOTOGRAPHS = f"photos candidates detectors cutouts decoys vmc_lib/data/real {COUNTEREXAMPLES}"
STEPS = (
    Step(RENDER, DATA_FOLDER / "photos", minutes=25, needs=MITSUBA),
    *(
        Step(f"{RENDER}.cutouts {kind}", file, minutes=6, needs=MITSUBA)
        for kind, file in cutout_atlas.FILES.items()
    ),
    Step(shipped_models.candidates, DATA_FOLDER / "candidates.npz", "photos", 4),
    Step(shipped_models.detectors, DATA_FOLDER / "detectors.npz", "photos candidates", 6),
    Step(shipped_models.localisers, DATA_FOLDER / "localisers.npz", "photos", 1),
    Step(shipped_models.cdbn, DATA_FOLDER / "cdbn.npz", "photos", 2),
    Step(shipped_models.recogniser, DATA_FOLDER / "recogniser.npz", "photos cdbn", 2),
    Step(arm_tables.make, DATA_FOLDER / "arm26.npz", "vmc_lib/arm", 0.1),
    Step(arm_tables.make_rest, DATA_FOLDER / "rest.npz", TABLES, 0.1),
    Step(shipped_models.templates, DATA_FOLDER / "templates.npz", ARM, 1),
    Step(localisation.make, RESULTS / "localisation.npz", "photos candidates detectors", 25),
    Step(recognition.make, RESULTS / "recognition.npz", "photos cdbn", 3),
    Step(hmax_draws.make, RESULTS / "hmax_draws.npz", "photos recognition", 3),
    Step(second_layers.make, RESULTS / "second_layers.npz", "photos cdbn", 2),
    Step(other_filters.make, RESULTS / "other_filters.json", "photos cdbn", 4),
    Step(random_filters.make, RESULTS / "random_filters.npz", "photos cdbn", 4),
    Step(
        region_clusters.make,
        RESULTS / "region_clusters.json",
        "photos candidates localisation",
        3,
    ),
    Step(class_independence.make, RESULTS / "class_independence.npz", "photos", 3),
    Step(cdbn_sensitivity.make, RESULTS / "variations.npz", "photos", 15),
    Step(crbm_ablation.make, RESULTS / "tricks.npz", "photos"),
    Step(optimal_control.make, RESULTS / "optimal.npz", f"templates {ARM}", 1),
    Step(minimum_variance.make, RESULTS / "steady.npz", f"templates {ARM}", 2),
    Step(calibration.make, RESULTS / "movements.json", f"templates {ARM}", 10),
    Step(nulls.make, RESULTS / "nulls.json", f"templates {ARM}", 12),
    Step(controller_comparison.make, RESULTS / "cerebella.json", f"templates {ARM}", 5),
    Step(feedback_control.make, RESULTS / "feedback.json", f"templates {ARM}", 8),
    Step(
        forgetting_adaptation.make,
        RESULTS / "forgetting.npz",
        f"templates reproduce/people {ARM}",
        15,
    ),
    Step(learning_under_noise.make, RESULTS / "unsteady.json", f"templates {ARM}", 3),
    Step(habits.make, RESULTS / "whole_arm_habits.npz", WHOLE_ARM),
    Step(
        learning_curves.make,
        RESULTS / "learning_curves.json",
        f"templates unsteady whole_arm_habits {ARM} {WHOLE_ARM}",
        15,
    ),
    Step(sensitivity.make, RESULTS / "sensitivity.json", f"templates {ARM}", 8),
    Step(muscle_weakness.make, RESULTS / "weakened.npz", f"templates {ARM}", 1),
    Step(rival_controllers.make, RESULTS / "rivals.json", f"templates optimal {ARM}", 6),
    Step(loop_evaluation.make, RESULTS / "lesions.json", SHIPPED, 6),
    Step(loop_evaluation.make_generalist, RESULTS / "generalist.json", SHIPPED, 1),
    Step(ventral_stream.photographs, DATA_FOLDER / "photographs.npz", PHOTOGRAPHS, 70),
    Step(real_world.make, RESULTS / "real_world.json", f"{SHIPPED} {COUNTEREXAMPLES}", 3),
    Step(eye_ablation.make, RESULTS / "eye_ablation.json", f"{SHIPPED} {COUNTEREXAMPLES}", 8),
    Step(pasted_scenes.make, RESULTS / "pasted_scenes.json", f"{SHIPPED} {COUNTEREXAMPLES}", 4),
    Step(f"{RENDER}.elsewhere {ELSEWHERE}", ELSEWHERE, minutes=15, needs="vtk"),
    Step(
        partial(real_world.make_elsewhere, ELSEWHERE),
        RESULTS / "elsewhere.json",
        SHIPPED,
        3,
        needs="elsewhere_photos",
    ),
    Step(domain_shift.make, RESULTS / "domains.npz", "photos", 8),
    Step(stream_ablation.make, RESULTS / "ablation.npz", PHOTOGRAPHS, 15),
    Step(f"{RENDER} --sheet --samples 16", DATA_FOLDER / "photos/sheet", minutes=5, needs=MITSUBA),
    Step(printed_sheet.make, RESULTS / "printed_sheet.json", f"sheet {SHIPPED}"),
    Step(
        f'{RENDER} --only "*/test" --first 40 --count 200 --folder {FRESH}',
        FRESH,
        minutes=40,
        needs=MITSUBA,
    ),
    Step(
        partial(fresh_test_set.make_names, FRESH),
        RESULTS / "fresh_names.npz",
        f"recognition hmax_draws {SHIPPED}",
        5,
        needs="fresh_photos",
    ),
    Step(
        partial(fresh_test_set.make, FRESH),
        RESULTS / "fresh_test_set.json",
        f"localisation {SHIPPED}",
        25,
        needs="fresh_photos",
    ),
    Step(
        ledger.make,
        RESULTS / "ledger.json",
        "localisation recognition fresh_names fresh_test_set variations hmax_draws second_layers "
        "other_filters random_filters region_clusters "
        "class_independence movements nulls unsteady learning_curves sensitivity optimal "
        "reproduce/results/opensim.npz "
        f"reproduce/results/bench {SHIPPED}",
        8,
    ),
    Step(experiment.make, RESULTS / "whole_arm.json", f"whole_arm_habits {WHOLE_ARM}", 8),
    Step(f"{PYTHON} reproduce.whole_arm.derive", plant.FILE, needs="myo-sim"),
    Step(f"{PYTHON} reproduce.whole_arm.bones", bones63.FILE, needs="myo-sim"),
    Step(
        f"{RENDER}.bone_meshes",
        bone_meshes.FILE,
        needs="arm26's bone meshes, GEOMETRY=path/to/folder",
    ),
    Step(OPENSIM, RESULTS / "opensim.npz", needs="OpenSim in .bench, ARM26=path/to/arm26.osim"),
)
