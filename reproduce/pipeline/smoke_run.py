"""Every step at toy size: a few photos, seeds and patches, to see in a minute that all of it runs.

What a step reads of other steps' files is what ships; what it makes is of no use.
"""

import json
from dataclasses import replace
from functools import partial
from itertools import product
from shutil import copy

import numpy as np

from render import scene
from reproduce import ledger
from reproduce.experiments import (
    calibration,
    cdbn_sensitivity,
    changed_worlds,
    class_independence,
    controller_comparison,
    crbm_ablation,
    domain_shift,
    feedback_control,
    fresh_test_set,
    hmax_draws,
    learning_under_noise,
    localisation,
    loop_evaluation,
    muscle_weakness,
    printed_sheet,
    real_world,
    recognition,
    second_layers,
    stream_ablation,
)
from reproduce.peers import minimum_variance, optimal_control
from reproduce.pipeline.progress import run_tasks
from reproduce.pipeline.steps import STEPS, write
from reproduce.training import arm_tables, shipped_models, ventral_stream
from reproduce.whole_arm import experiment, habits
from vmc_lib import photos
from vmc_lib.where.recipes import EVERY_RECIPE, RECIPES

# Numbers of each level's photos; of the first two, one's shuttlecock stands and one's lies
FEW = {"train": (0, 2), "validation": (1,), "test": (1,)}
# of each split a photo with a shuttlecock and one with none
REAL = {"train": (1, 74), "validation": (13, 79), "test": (17, 80)}
NAMED = {"train": (0,), "validation": (1, 2), "test": (1,)}  # Platt's sigmoid asks for two each
PATCHES = 200  # of the pictures that a network learns from
LATER = 200  # what turns the number of a photo that ships into that of a later one


def toy_steps(folder):
    """What a toy step's file holds, to be called, by the step's name; `folder` takes photos."""
    few, named, fresh = (folder / name for name in ("few", "named", "fresh"))
    copy_photos(few, FEW)
    copy_photos(named, NAMED)
    copy_photos(fresh, {"test": FEW["test"]}, LATER)
    for place in (few, named):
        copy_real(place)
    small = {"boxes": 100, "regressions": (0.1,)}
    improved, photographed = (
        replace(EVERY_RECIPE[name], **small) for name in ("improved", "photographed")
    )
    recipes = EVERY_RECIPE | {"improved": improved, "photographed": photographed}
    size = {"movements": 2, "held_out": 4, "experiments": 1}
    experiments = {
        "tables": partial(calibration.error_ratios, scenario=calibration.SCENARIOS[1], **size),
        "perturbations": partial(
            changed_worlds.block_errors, before=20, blocks=(1, 1, 1), movements=2
        ),
    }
    one = {"reflex alone": {0.5: feedback_control.REFLEX}}
    watched = {
        "gains": partial(feedback_control.gain_sweep, by_gain=one, count=2, seconds=2.0),
        "reaches": partial(feedback_control.reach_measures, count=2, seconds=2.0),
        "field": partial(feedback_control.curl_field_errors, blocks=(1, 1, 1)),
    }
    return {
        "photos": scenes,
        "candidates": partial(shipped_models.candidates, few, ["test"]),
        "detectors": partial(shipped_models.detectors, few, recipes),
        "localisers": partial(shipped_models.localisers, few),
        "cdbn": partial(shipped_models.cdbn, few, PATCHES),
        "recogniser": partial(shipped_models.recogniser, named),
        "arm26": arm_tables.make,
        "rest": arm_tables.make_rest,
        "templates": partial(shipped_models.templates, [0.16]),
        "localisation": partial(
            localisation.make, few, RECIPES | {"improved": improved}, trainings=1
        ),
        "recognition": partial(recognition.make, named, prototypes=20),
        "fresh_names": partial(fresh_test_set.make_names, fresh),
        "hmax_draws": partial(hmax_draws.make, named, draws=2),
        "second_layers": partial(second_layers.make, few, [0], patches=50, every=1),
        "class_independence": partial(class_independence.make, few, {"rig": ["single"]}),
        "variations": partial(cdbn_sensitivity.make, [(6, 0)], named, PATCHES),
        "tricks": partial(crbm_ablation.make, few, epochs=1, patches=50),
        "optimal": partial(optimal_control.make, optimal_control.TARGETS[12:13]),
        "steady": partial(minimum_variance.make, optimal_control.TARGETS[12:13], 0, ftol=1.0),
        "movements": partial(calibration.make, experiments, seeds=[0]),
        "cerebella": partial(controller_comparison.make, seeds=[0], movements=(2, 4), held_out=4),
        "feedback": partial(feedback_control.make, watched, seeds=[0]),
        "unsteady": partial(learning_under_noise.make, [0], seeds=[0], sizes=(2, 4), held_out=8),
        "weakened": partial(
            muscle_weakness.make, [0], muscle_weakness.TARGETS[:1], ["BRA"], count=2, before=20
        ),
        "fresh_test_set": partial(
            fresh_test_set.make, fresh, named, trainings=1, seeds=[0], patches=PATCHES
        ),
        "lesions": partial(loop_evaluation.make, ["rig"], few),
        "generalist": partial(loop_evaluation.make_generalist, ["rig"], few),
        "photographs": partial(
            ventral_stream.photographs, few, (2, 1), (2, 2, 2, 2), everyday=1, pasted=2
        ),
        "real_world": partial(real_world.make, few, splits=["validation"]),
        "elsewhere": partial(real_world.make_elsewhere, few),
        "domains": partial(domain_shift.make, few, [4], equal=4, draws=2, patches=PATCHES, steps=2),
        "ablation": partial(stream_ablation.make, few, draws=1, steps=2, everyday=1, pasted=2),
        "printed_sheet": partial(printed_sheet.make, count=1),
        "whole_arm_habits": partial(habits.make, habits.goal_grid(2)[:2]),
        "whole_arm": partial(experiment.make, [2], [14], seeds=[0], count=1),
        "ledger": partial(ledger.make, ledger.ROWS[-1:], levels=()),
    }


def run_all(folder):
    """Run all toy steps, one after the other in this process; what they make lies in `folder`."""
    kinds = {step.name: step.file.suffix or ".npz" for step in STEPS}
    made = toy_steps(folder)
    tasks = [
        {"basename": name, "actions": [(write, [folder / f"{name}{kinds[name]}", make])]}
        for name, make in made.items()
    ]
    return run_tasks(tasks, made, folder)


def copy_photos(folder, numbers, later=0):
    """Some of the photos that ship (split -> numbers), as if they were numbered `later`."""
    for level, split in product(photos.LEVELS, numbers):
        shipped, copied = (place / level / split for place in (photos.FOLDER, folder))
        copied.mkdir(parents=True)
        for number in numbers[split]:
            old, new = shipped / f"{number:03d}.json", copied / f"{number + later:03d}.json"
            truth = json.loads(old.read_bytes())
            truth["seed"][-1] += later
            new.write_text(json.dumps(truth), encoding="utf-8", newline="\n")
            copy(old.with_suffix(".jpg"), new.with_suffix(".jpg"))


def copy_real(folder):
    """The photos of `REAL`."""
    for split, numbers in REAL.items():
        shipped, copied = (place / "real" / split for place in (photos.FOLDER, folder))
        copied.mkdir(parents=True)
        for number, kind in product(numbers, ("jpg", "json")):
            copy(shipped / f"{number:03d}.{kind}", copied)


def scenes():
    """A scene of each level, drawn but not rendered: the vertices of its things, by name."""
    drawn = {level: scene.draw(level, np.random.default_rng(0)) for level in photos.LEVELS}
    return {
        f"{level}/{name}": mesh.vertices
        for level, one in drawn.items()
        for name, mesh in one.things.items()
    }
