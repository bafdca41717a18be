"""Error and processor seconds against the amount of training: templates, movements, photos.

Every point is a job of its own, handed to joblib: `parallel_config` decides where the jobs run.
With `PHOTOS=folder`, the varied training photos come from there, and may be more than ship:

    python -m reproduce.render --only varied/train --count 400 --folder folder
"""

import os
from itertools import pairwise
from time import process_time

import numpy as np
from joblib import Parallel, delayed, parallel_config

from reproduce.measures.precision_recall import precision_recall
from reproduce.training import reach_templates
from reproduce.training.detectors import fit_detector
from tools.bench.report import publish
from vmc_lib import photos
from vmc_lib.cerebellum.online import AimCorrection
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.inverse_dynamics import spline
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.where.recipes import RECIPES

SPACINGS = (0.08, 0.06, 0.04, 0.03, 0.02)  # m
ON_THE_TABLE = (0.08, -0.42), (0.22, -0.38)  # m: where the photos' shuttlecocks lie, in the plane
MOVEMENTS = (0, 25, 50, 100, 250, 500, 1000, 2500)
PHOTOS = (10, 20, 40, 80, 160, 400)
FOLDER = os.environ.get("PHOTOS", photos.FOLDER)


def more_templates(spacing):
    """Mean planned error (mm) of a template set with this spacing (m)."""
    start = process_time()
    goals = reach_templates.reachable_grid(spacing)
    excitations = spline() @ np.array([reach_templates.find_reach(goal) for goal in goals])
    seconds = process_time() - start
    template_set = templates.simulate_templates(excitations)
    held_out = np.random.default_rng(0).uniform(*ON_THE_TABLE, (200, 2))
    error = 1000 * execute(plan(held_out, template_set)).error.mean()
    return [row("templates", len(goals), error, seconds)]


def more_movements():
    """Held-out error over planned error, as granule cells learn from more movements."""
    template_set, rng = templates.load(), np.random.default_rng(0)
    held_out = plan(draw_targets(template_set, 200, rng), template_set)
    learner, seconds = AimCorrection(template_set), 0.0
    rows = []
    for previous, count in pairwise(MOVEMENTS):
        targets = draw_targets(template_set, count - previous, rng)
        start = process_time()
        learner.update(plan(targets, template_set))
        seconds += process_time() - start
        error = execute(learner.correct(held_out)).error.mean() / execute(held_out).error.mean()
        rows.append(row("movements", count, error, seconds))
    return rows


def more_photos(count):
    """Share of validation objects missed by a detector trained on so many varied photos."""
    training = photos.load("varied", "train", FOLDER)[:count]
    validation = photos.load("varied", "validation")
    start = process_time()
    detector = fit_detector(training, RECIPES["improved"], np.random.default_rng(0))
    seconds = process_time() - start
    boxes = [detector.detect(photo.image).boxes for photo in validation]
    return [row("photos", count, 1 - precision_recall(validation, boxes)[1], seconds)]


def row(more, size, error, seconds):
    """One point of a curve."""
    return {"more": more, "size": size, "error": round(error, 4), "seconds": round(seconds, 2)}


if __name__ == "__main__":
    available = len(photos.load("varied", "train", FOLDER))
    jobs = [
        *(delayed(more_photos)(count) for count in PHOTOS[::-1] if count <= available),
        *(delayed(more_templates)(spacing) for spacing in SPACINGS[::-1]),
        delayed(more_movements)(),
    ]
    with parallel_config("loky", n_jobs=-1, inner_max_num_threads=1):
        points = [point for points in Parallel()(jobs) for point in points]
    publish("scaling", sorted(points, key=lambda point: (point["more"], point["size"])))
