"""Localisation with a printed marker sheet instead of a known camera, on rendered photos."""

import numpy as np
from joblib import Parallel, delayed

from reproduce.experiments.real_world import MODELS, SIZED
from vmc_lib import NoReach, marker_sheet, photos
from vmc_lib.loop import VisuomotorModel, locate, see

FROM_SHEET = ", camera from the sheet"


def make(folder=photos.FOLDER, models=MODELS, count=None):
    """What `results/printed_sheet.json` holds: way -> how far off each place is (mm), or None.

    Of the true box with the true camera; of the true box with the sheet's camera; and of the box
    that each model chooses, with the sheet's camera: from what it sees alone, and where it also
    counts how large things are.
    """
    shots = photos.load(photos.SHEET_LEVEL, "test", folder)[:count]
    loaded = {name: VisuomotorModel.load(name) for name in models}
    rows = Parallel()(delayed(photo_errors)(photo, loaded) for photo in shots)
    return {way: [row[way] for row in rows] for way in rows[0]}


def photo_errors(photo, models):
    """The row of one photo."""
    camera, bare = marker_sheet.remove_sheet(photo.image)
    true = photo.boxes["shuttlecock"]
    [model, *_] = models.values()  # all have the same localiser
    row = {
        "true box, true camera": _error(photo, bare, model, true, photo.camera),
        f"true box{FROM_SHEET}": _error(photo, bare, model, true, camera),
    }
    for name, model in models.items():
        for way, known in (("", None), (SIZED, camera)):
            box = see(model, bare, known).box
            row[f"box of {name}{FROM_SHEET}{way}"] = _error(photo, bare, model, box, camera)
    return row


def _error(photo, bare, model, box, camera):
    try:
        place = locate(model, bare, box, camera)
    except NoReach:
        return None
    return round(1000 * float(np.linalg.norm(place - photo.target)), 1)
