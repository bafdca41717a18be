"""Every step at toy size: a few photos, seeds and patches, to see in a minute that all of it runs.

What a step reads of other steps' files is what ships; what it makes is of no use.
"""

import json
from dataclasses import replace
from functools import partial
from itertools import product
from shutil import copy

import numpy as np

from reproduce import ledger
from reproduce.experiments import (
    calibration,
    feedback_control,
    learning_curves,
    muscle_weakness,
    nulls,
)
from reproduce.measures import changed_worlds
from reproduce.peers import optimal_control
from reproduce.pipeline.progress import run_tasks
from reproduce.pipeline.steps import STEPS, write
from reproduce.render import scene
from reproduce.whole_arm import habits
from vmc_lib import photos
from vmc_lib.where.recipes import EVERY_RECIPE, RECIPES

# Numbers of each level's photos; of the first two, one's shuttlecock stands and one's lies
FEW = {"train": (0, 2), "validation": (1,), "test": (1,)}
# of each split a photo with a shuttlecock and one with none
REAL = {"train": (1, 74), "validation": (13, 79), "test": (17, 80)}
NAMED = {"train": (0,), "validation": (1, 2), "test": (1,)}  # Platt's sigmoid asks for two each
PATCHES = 200  # of the pictures that a network learns from
LATER = 200  # what turns the number of a photo that ships into that of a later one


def toy(name, *arguments, **size):
    """A step's name, and what makes its file with arguments that keep it small."""
    [function] = (step.function for step in STEPS if step.name == name)
    return name, partial(function, *arguments, **size)


def toy_steps(folder):
    """What a toy step's file holds, to be called, by the step's name; `folder` takes photos."""
    few, named, fresh = (folder / name for name in ("few", "named", "fresh"))
    copy_photos(few, FEW)
    copy_photos(named, NAMED)
    copy_photos(fresh, {"test": FEW["test"]}, LATER)
    for place in (few, named):
        copy_real(place)
    small = {"boxes": 100, "regressions": (0.1,)}
    improved = replace(RECIPES["improved"], **small)
    recipes = EVERY_RECIPE | {"improved": improved}
    size = {"movements": 2, "held_out": 4, "experiments": 1}
    experiments = {
        "tables": partial(calibration.error_ratios, scenario=calibration.SCENARIOS[1], **size),
        "perturbations": partial(
            changed_worlds.block_errors, before=20, blocks=(1, 1, 1), movements=2
        ),
    }
    by_luck = {
        nulls.BY_TRIES: partial(nulls.errors_by_tries, count=2),
        nulls.BY_TEACHING: partial(nulls.errors_after_teaching, movements=2, held_out=4),
    }
    one = {"reflex alone": {0.5: feedback_control.REFLEX}}
    watched = {
        "gains": partial(feedback_control.gain_sweep, by_gain=one, count=2, seconds=2.0),
        "dampings": partial(
            feedback_control.damping_sweep, by_both={"late sight": [(2, 1.5)]}, count=2
        ),
        "reaches": partial(feedback_control.reach_measures, count=2, seconds=2.0),
        "field": partial(feedback_control.curl_field_errors, blocks=(1, 1, 1)),
    }
    curves = {
        "off-line": partial(learning_curves.offline_curves, count=2),
        "rounds": partial(learning_curves.round_misses, count=2),
        "with a load": partial(learning_curves.with_load, count=2),
        "worlds": partial(learning_curves.changed_worlds, before=20, blocks=(1, 1, 1), movements=2),
        "whole arm": partial(learning_curves.whole_arm, count=1, trials=1),
        "memories": partial(
            learning_curves.memory_curves, count=1, trials=1, sides=(2,), shared=()
        ),
    }
    toys = (
        toy("candidates", few, ["test"]),
        toy("detectors", few, recipes),
        toy("localisers", few),
        toy("cdbn", few, PATCHES),
        toy("recogniser", named),
        toy("arm26"),
        toy("rest"),
        toy("templates", [0.16]),
        toy("localisation", few, RECIPES | {"improved": improved}, trainings=1),
        toy("recognition", named, prototypes=20),
        toy("fresh_names", fresh),
        toy("hmax_draws", named, draws=2),
        toy("second_layers", few, [0], patches=50, every=1),
        toy("other_filters", few, count=200, every=1, seeds=[0]),
        toy("random_filters", named, [0]),
        toy("region_clusters", few, {"rig": {"published": ["linear"]}}),
        toy("class_independence", few, {"rig": ["single"]}),
        toy("variations", [(6, 0)], named, PATCHES),
        toy("tricks", few, epochs=1, patches=50),
        toy("optimal", optimal_control.TARGETS[12:13]),
        toy("steady", optimal_control.TARGETS[12:13], 0, ftol=1.0),
        toy("movements", experiments, seeds=[0]),
        toy("nulls", by_luck, seeds=[0]),
        toy("cerebella", seeds=[0], movements=(2, 4), held_out=4),
        toy("feedback", watched, seeds=[0]),
        toy("forgetting", [0.45], [0.05], seeds=[0]),
        toy("unsteady", [0], seeds=[0], sizes=(2, 4), held_out=8),
        toy("learning_curves", curves, seeds=[0]),
        toy("sensitivity", {}, 0.08, [0], 2, movements=2, held_out=4),
        toy("weakened", [0], muscle_weakness.TARGETS[:1], ["BRA"], count=2, before=20),
        toy("fresh_test_set", fresh, named, trainings=1, seeds=[0], patches=PATCHES),
        toy("rivals", optimal_control.TARGETS[9:10], 2, [(0.0, 0.4)], [3.0], [0.25], 1),
        toy("lesions", ["rig"], few),
        toy("generalist", ["rig"], few),
        toy("photographs", few, (2, 1), (2, 2, 2, 2), everyday=1, pasted=2),
        toy("real_world", few, splits=["validation"]),
        toy("eye_ablation", count=1),
        toy("pasted_scenes", ["validation"], 1),
        toy("elsewhere", few),
        toy("domains", few, [4], equal=4, draws=2, patches=PATCHES, steps=2),
        toy("ablation", few, draws=1, steps=2, everyday=1, pasted=2),
        toy("printed_sheet", count=1),
        toy("whole_arm_habits", habits.goal_grid(2)[:2]),
        toy("whole_arm", (2,), (14,), sparse_memories(), seeds=[0], count=1),
        toy("ledger", ledger.ROWS[-1:], levels=()),
    )
    return {"photos": scenes, **dict(toys)}


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


def sparse_memories():
    """Every other memory of the whole arm along each edge of its zone: 27 of the 125 that ship."""
    past, side = habits.load_templates(), habits.SIDE
    rows = np.arange(side**3).reshape(side, side, side)[::2, ::2, ::2].ravel()
    return replace(past, points=past.points[rows], excitations=past.excitations[rows])


def scenes():
    """A scene of each level, drawn but not rendered: the vertices of its things, by name."""
    drawn = {level: scene.draw(level, np.random.default_rng(0)) for level in photos.LEVELS}
    return {
        f"{level}/{name}": mesh.vertices
        for level, one in drawn.items()
        for name, mesh in one.things.items()
    }
