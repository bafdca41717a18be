"""Wrong calls of public functions: each is told what is wrong, with the value, and the remedy."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
import torch
from ipywidgets import Dropdown

from vmc_lib import box_selection, boxes, loop, marker_sheet, photos, statistics
from vmc_lib.arm import arm26, dynamics, kinematics, muscle, simulate
from vmc_lib.cerebellum import (
    adaptation,
    feedback_error,
    forward_model,
    offline,
    online,
    two_rates,
)
from vmc_lib.motor import execution, feedback, inverse_dynamics, planning, templates
from vmc_lib.show import (
    COLOURS,
    Pad,
    Scene,
    Slider,
    Switch,
    check,
    compare,
    estimate,
    explore,
    figure,
    grade,
    note,
    photo_view,
    solution,
    table,
    widget,
)
from vmc_lib.show.arm import arm_scene
from vmc_lib.what import cdbn, crbm, crops, learning, recogniser, stream
from vmc_lib.where import (
    box_regression,
    detector,
    features,
    localiser,
    recipes,
    segmentation,
    selective_search,
    svm,
)


@cache
def given():
    """A model, a photo and a plan, as right calls have them."""
    model, photo = loop.VisuomotorModel.load("rig"), photos.load("rig", "train")[0]
    plans = planning.plan(np.array([[0.1, -0.38], [0.15, -0.4]]), model.template_set)
    reach = loop.reach(model, photo.target, calibration=None)
    seen = {"model": model, "photo": photo, "image": photo.image}
    return SimpleNamespace(**seen, plan=plans[0], plans=plans, reach=reach)


def reference(g):
    return feedback.reference_trajectory(g.plans, 1.0)


def excite(value, start=(0, 1), muscles=6):
    return simulate.simulate(np.full((10, muscles), value), start)


def text(k):
    return f"<p>{k}</p>"


def pointed(g):
    """A demo with a pad on a photo."""

    def draw(p):
        return photo_view(g.image, points=[(p, "", "red")])

    return widget(draw, alt="a photo", p=Pad([0, 9], [0, 9]))


def see_by(g, **parts):
    return replace(g.photo.camera, **parts).project([g.photo.target])


def found(g):
    return detector.Detections(*(np.zeros((1, n)) for n in (4, 1, 4, 4, 1)))


def tree():
    return next(selective_search.hierarchies(BLANK, selective_search.STRATEGIES["single"]))


def learner():
    return learning.Learner.random(2, 1, 5, torch.Generator())


def field(field=simulate.UNPERTURBED.field, load=0.0):
    return simulate.Perturbation(load, field)


def corrected(g, **gains):
    return feedback.simulate_feedback(reference(g), feedback.SIGHT._replace(**gains))


def adapting(g, **how):
    trained = online.AimCorrection(g.model.template_set)
    return adaptation.Adaptation(trained, g.model.template_set, **how)


def cells():
    return online.GranuleCells().fit(np.eye(2), np.eye(2))


RAGGED = [[1, 2], [3]]
BOX, RNG, STREAM = [[0, 0, 9, 9]], np.random.default_rng(0), stream.VentralStream.load()
NOISE, BLANK = RNG.random((3, 20, 20)), np.zeros((40, 60, 3))


SIGHT = {  # a call: what its error says, the value and the remedy
    "a level": (lambda g: photos.load("rigg", "train"), "'rigg'", "choose from"),
    "a split": (lambda g: photos.load("rig", "valid"), "'valid'", "choose from ('train'"),
    "a model's level": (lambda g: loop.VisuomotorModel.load("hard"), "'hard'", "choose from rig"),
    "a detector": (lambda g: detector.ObjectDetector.load("rig", "best"), "'best'", "choose from"),
    "a recogniser": (lambda g: recogniser.Recogniser.load("rig", "P3"), "'P3'", "choose from MP2"),
    "a grey image": (lambda g: loop.see(g.model, g.image[..., 0]), "(400, 600)", "read_image"),
    "floats": (lambda g: loop.see(g.model, g.image / 255), "float64", "read_image"),
    "a level for a model": (lambda g: loop.see("rig", g.image), "'rig'", 'load("rig")'),
    "an image first": (lambda g: loop.see(g.image, g.model), "array(400", 'load("rig")'),
    "a photo for a camera": (
        lambda g: loop.see(g.model, g.image, g.photo), "Photo(", "give photo.camera"
    ),
    "a photo for a target": (lambda g: loop.reach(g.model, g.photo), "Photo(", "give numbers"),
    "a list of pixels": (lambda g: photos.crops([[1]], [0, 0, 1, 1], 9), "[[1]]", "read_image"),
    "scores in words": (lambda g: boxes.nms([[0, 0, 1, 1]], "good"), "'good'", "give numbers"),
    "a file": (lambda g: loop.see(g.model, "a.jpg"), "'a.jpg'", "give read_image('a.jpg')"),
    "a photo": (lambda g: loop.see(g.model, g.photo), "'rig/train/000'", "give photo.image"),
    "a missing file": (lambda g: photos.read_image("nowhere.jpg"), "nowhere.jpg", "name right?"),
    "a folder's list": (lambda g: photos.read_image(["a.jpg"]), "list", "give a path"),
    "integers": (lambda g: photos.as_rgb([[1, 2], [3, 4]]), "int64", "give uint8"),
    "8 bits as floats": (lambda g: photos.as_rgb(g.image * 1.0), "0..1", "divide 8 bits by 255"),
    "a size": (lambda g: photos.crops(g.image, [[0, 0, 5, 5]], -2), "size = -2", "1 or more"),
    "a box of three": (lambda g: boxes.iou([[1, 2, 3]], [0, 0, 1, 1]), "(1, 3)", "(x0, y0, x1"),
    "a box inside out": (lambda g: boxes.iou([5, 5, 1, 1], [0, 0, 3, 3]), "[5. 5.", "x0 <= x1"),
    "too few scores": (lambda g: boxes.nms([[0, 0, 1, 1]], [0.3, 0.4]), "(2,)", "as many finite"),
    "an overlap": (lambda g: boxes.nms([[0, 0, 1, 1]], [0.3], 3), "overlap = 3", "within 0..1"),
    "an empty box": (lambda g: crops.crop(g.image, (0, 0, 0, 0)), "(0, 0, 0, 0)", "600×400"),
    "pixels": (lambda g: g.photo.camera.back_project([[1, 2, 3]]), "(1, 3)", "give (n, 2)"),
    "points": (lambda g: g.photo.camera.project([[1, 2]]), "(1, 2)", "give (n, 3)"),
    "a strategy": (lambda g: selective_search.propose(g.image, "x"), "'x'", "single, fast"),
    "a scale": (lambda g: segmentation.segment(g.image / 255, k=-1), "k = [-1]", "above 0"),
    "channels": (lambda g: segmentation.segment(g.image[..., 0]), "(400, 600)", "(height, width"),
    "a kernel": (lambda g: svm.KernelSVM.fit(np.eye(2), [1, 0], "cubic"), "'cubic'", "linear, po"),
    "one class": (lambda g: svm.KernelSVM.fit(np.eye(2), [1, 1]), "counter-examples", "more"),
    "large crops": (
        lambda g: g.model.recogniser.probability(np.zeros((2, 1, 100, 100))),
        "(2, 1, 100, 100)", "give grey ones (n, 200, 200)",
    ),
    "layers": (lambda g: cdbn.CDBN.load().layers(np.zeros((1, 9, 9))), "v is (n, 1", "not (1, 9"),
    "random numbers": (
        lambda g: learning.Learner.random(2, 1, 5, np.random.default_rng(0)),
        "PCG64", "give a torch.Generator()",
    ),
    "no filters": (
        lambda g: learning.Learner.random(-1, 1, 5, torch.Generator()), "K = -1", "1 or more"
    ),
    "no photo": (lambda g: photos.boxes_of("rig", "cup"), "'rig'", "give one of load("),
    "a file to crop": (lambda g: crops.crop("a.jpg", (0, 0, 9, 9)), "'a.jpg'", "read_image"),
    "a photo to crop": (
        lambda g: g.model.recogniser.box_probability(g.photo, [[0, 0, 9, 9]]),
        "Photo(…)", "read_image",
    ),
    "a crop of three": (lambda g: crops.crop(g.image, (0, 0, 9)), "(1, 3)", "(x0, y0, x1, y1)"),
    "a file to segment": (lambda g: segmentation.segment("a.jpg"), "'a.jpg'", "photos.as_float"),
    "a margin": (lambda g: boxes.pad_boxes([0, 0, 9, 9], "wide"), "'wide'", "give one number"),
    "an amount": (
        lambda g: boxes.jitter_boxes([[0, 0, 9, 9]], "much", np.random.default_rng(0)),
        "'much'", "give numbers",
    ),
    "a height": (
        lambda g: g.photo.camera.back_project([[300, 300]], "table"), "'table'", "give numbers"
    ),
    "boxes for detections": (
        lambda g: box_selection.filter_by_size([[0, 0, 9, 9]], g.photo.camera),
        "[[0, 0, 9, 9]]", "detect(image)",
    ),
    "odds": (lambda g: box_selection.scale_odds(0.5, "five"), "'five'", "give numbers"),
    "no camera to locate by": (
        lambda g: g.model.localiser.locate(g.image, (0, 0, 9, 9), None), "None", "photo.camera"
    ),
    "a third box kept": (
        lambda g: boxes.vote([2], [[0, 0, 9, 9]] * 2, [0.1, 0.2]), "[2.0]", "indices of the 2 boxes"
    ),
    "one kept": (lambda g: boxes.vote(0, [[0, 0, 9, 9]], [0.1]), "kept 0.0", "as nms does"),
    "kept by name": (lambda g: boxes.vote(["a"], [[0, 0, 9, 9]], [1]), "['a']", "give numbers"),
    "a score of two": (
        lambda g: boxes.vote([0], [[0, 0, 9, 9]] * 2, [0.1]), "(1,)", "as many finite scores"
    ),
    "no temperature": (
        lambda g: boxes.vote([0], [[0, 0, 9, 9]], [1], 0), "temperature = 0", "above 0"
    ),
    "deltas of three": (
        lambda g: boxes.decode_deltas([0, 0, 9, 9], [[0, 0, 0]]), "(1, 3)", "a row of 4 for each"
    ),
    "a delta alone": (lambda g: boxes.decode_deltas([0, 0, 9, 9], 0.1), "()", "a row of 4"),
    "two true boxes of three": (
        lambda g: boxes.encode_deltas([[0, 0, 9, 9]] * 3, [[0, 0, 9, 8]] * 2), "(2, 4)", "3 boxes"
    ),
    "three labels": (lambda g: svm.KernelSVM.fit(np.eye(2), [0, 1, 1]), "(2, 2)", "n labels"),
    "a step of nothing": (lambda g: photos.load_levels("train", step=0), "step = 0", "1 or more"),
    "a folder of no name": (lambda g: photos.load("rig", "train", None), "folder None", "the path"),
    "rows of two lengths": (lambda g: photos.as_rgb([[1], [1, 2]]), "[[1], [1, 2]]", "(h, w, 3)"),
    "half a pixel more": (lambda g: photos.crops(g.image, BOX, 2.5), "size = 2.5", "whole number"),
    "a size as text": (lambda g: photos.crops(g.image, BOX, "9"), "size = '9'", "a whole number"),
    "a point that is none": (
        lambda g: g.photo.camera.project([[np.nan, 0, 0]]), "no picture", "it faces"
    ),
    "a lens in words": (lambda g: see_by(g, focal="35 mm"), "'35 mm'", "give numbers"),
    "a camera's angles": (lambda g: see_by(g, rotation=(0, 30, 0)), "(0, 30, 0)", "(3, 3)"),
    "a middle in space": (lambda g: see_by(g, centre=(1, 2, 3)), "(1, 2, 3)", "numbers, (2,)"),
    "an area of three": (lambda g: boxes.area([1, 2, 3]), "[1, 2, 3]", "(x0, y0, x1, y1)"),
    "an area of words": (lambda g: boxes.area("box"), "'box'", "(x0, y0, x1, y1)"),
    "a middle of three": (
        lambda g: boxes.centres_and_sides([1, 2, 3]), "[1, 2, 3]", "(x0, y0, x1, y1)"
    ),
    "a score as text in an array": (
        lambda g: boxes.nms(BOX, np.array("x")), "scores x is", "give numbers"
    ),
    "a jitter of three": (
        lambda g: boxes.jitter_boxes([[0, 0, 9]], 0.1, RNG), "[[0.0, 0.0, 9.0]]", "(x0, y0, x1, y1)"
    ),
    "ragged boxes": (lambda g: boxes.area(RAGGED), "[[1, 2], [3]]", "rows of a length"),
    "a jitter without end": (lambda g: boxes.jitter_boxes(BOX, np.inf, RNG), "inf", "0 or more"),
    "a jitter of none": (lambda g: boxes.jitter_boxes(BOX, [], RNG), "[]", "one share"),
    "less than no jitter": (lambda g: boxes.jitter_boxes(BOX, -0.1, RNG), "-0.1", "0 or more"),
    "no boxes for nms": (lambda g: boxes.nms(None, []), "boxes None", "give numbers"),
    "a flat box": (lambda g: boxes.encode_deltas([0, 0, 0, 9], BOX), "[0. 0. 0. 9.]", "leave it"),
    "a margin of NaN": (lambda g: boxes.pad_boxes(BOX, np.nan), "nan", "above -0.5"),
    "a margin inside out": (lambda g: boxes.pad_boxes(BOX, -1), "margin -1", "above -0.5"),
    "three margins": (lambda g: boxes.pad_boxes(BOX, [0.1, 0.2, 0.3]), "[0.1, 0.2", "one number"),
    "no camera to measure by": (
        lambda g: box_selection.filter_by_size(found(g), None), "camera None", "photo.camera"
    ),
    "more than sure": (lambda g: box_selection.scale_odds(1.5, 2), "1.5", "give 0 to 1"),
    "odds below none": (lambda g: box_selection.scale_odds(0.5, -1), "ratio -1.0", "0 or more"),
    "odds without end": (lambda g: box_selection.scale_odds(0.5, np.inf), "inf", "finite ratio"),
    "two places": (
        lambda g: loop.locate(g.model, g.image, BOX * 2, g.photo.camera), "2 boxes", "give one"
    ),
    "a place of no box": (
        lambda g: loop.locate(g.model, g.image, [], g.photo.camera), "0 boxes", "give one"
    ),
    "a photo to see by": (
        lambda g: loop.see_and_reach(g.model, g.image, g.photo), "Photo(…)", "photo.camera"
    ),
    "a paper": (lambda g: marker_sheet.page_image("A5"), "'A5'", "choose from A4"),
    "markers in floats": (lambda g: marker_sheet.detect_markers(g.image / 255), "400", "as_rgb"),
    "markers in a file": (lambda g: marker_sheet.detect_markers("a.jpg"), "'a.jpg'", "as_rgb"),
    "no markers": (
        lambda g: marker_sheet.calibrate_camera([], np.zeros((0, 4, 2)), (400, 600)),
        "0 markers", "3 markers or more",
    ),
    "one probability": (lambda g: g.model.recogniser.probability(None), "shape ()", "give grey"),
    "boxes of nothing": (
        lambda g: g.model.recogniser.box_probability(g.image, None), "boxes None", "give numbers"
    ),
    "boxes to select": (lambda g: g.model.recogniser.select(g.image, BOX), "[[0, 0", "detect(im"),
    "boxes for a stream": (lambda g: STREAM.select(g.image, BOX), "[[0, 0, 9, 9]]", "detect(im"),
    "how many to look at": (
        lambda g: STREAM.select(g.image, found(g), refined="all"), "'all'", "whole number"
    ),
    "no look at all": (
        lambda g: STREAM.select(g.image, found(g), looks=0), "looks = 0", "1 or more"
    ),
    "nothing for a stream": (lambda g: STREAM.predict(g.image, None), "boxes None", "numbers"),
    "a grey stream": (
        lambda g: STREAM.stages(np.zeros((1, 1, 48, 48))), "(1, 1, 48, 48)", "(n, channels, h"
    ),
    "features of another": (
        lambda g: g.model.recogniser.classifier.probability(np.zeros((1, 3))), "(1, 3)", "rows of"
    ),
    "filters in lists": (lambda g: crbm.CRBM([[[[1.0]]]], [0], [0]), "[[[[1.0]]]]", "np.array"),
    "blocks of nothing": (
        lambda g: crbm.CRBM(np.ones((1, 1, 2, 2)), np.zeros(1), np.zeros(1), 0), "c = 0", "1 or m"
    ),
    "a picture in lists": (lambda g: cdbn.CDBN.load().first.posterior([[1]]), "(1, 1)", "v is (n"),
    "hidden units of another": (
        lambda g: crbm.CRBM(np.ones((1, 1, 2, 2)), np.zeros(1), np.zeros(1)).energy(
            np.ones((1, 1, 5, 5)), np.ones((1, 1, 3, 3))
        ),
        "(1, 1, 3, 3)", "give (1, 1, 4, 4)",
    ),
    "a map alone": (
        lambda g: crbm.correlate_valid(np.ones((5, 5)), np.ones((2, 2))), "(5, 5)", "(n, channels"
    ),
    "hidden maps": (
        lambda g: cdbn.CDBN.load().first.visible_mean(np.ones((1, 3, 5, 5))),
        "(1, 3, 5, 5)", "(n, channels",
    ),
    "words to whiten": (lambda g: crops.whiten("photo"), "'photo'", "give numbers"),
    "no cutoff": (lambda g: crops.whiten(NOISE, 0), "cutoff = 0", "above 0"),
    "a cutoff in words": (lambda g: crops.whiten(NOISE, "fine"), "'fine'", "above 0"),
    "a row to crop": (lambda g: crops.crop(np.zeros(5), BOX[0]), "array(5,)", "read_image"),
    "two crops": (lambda g: crops.crop(g.image, BOX * 2), "2 boxes", "give one alone"),
    "photos by name": (lambda g: cdbn.crops_of("rig"), "'rig'", 'load("rig", "train")'),
    "a photo alone": (lambda g: cdbn.crops_of(g.photo), "Photo(…)", "give a list"),
    "half a filter": (
        lambda g: learning.Learner.random(2.5, 1, 5, torch.Generator()), "K = 2.5", "1 or more"
    ),
    "no flips": (lambda g: STREAM.predict(g.image, BOX, ()), "flips ()", "one or more"),
    "a flip alone": (lambda g: STREAM.predict(g.image, BOX, (1, 1)), "flips (1, 1)", "one or more"),
    "another flip": (lambda g: STREAM.predict(g.image, BOX, [(2, 1)]), "(2, 1)", "(-1, -1)"),
    "epochs": (lambda g: learner().fit(torch.zeros(2, 1, 14, 14), 3, 0), "= 3", "range(3)"),
    "patches of NumPy": (
        lambda g: learner().fit(np.zeros((2, 1, 14, 14)), range(1), 0), "ndarray", "torch.Tensor"
    ),
    "no steps": (
        lambda g: learner().fit(torch.zeros(2, 1, 14, 14), range(1), 0, steps=0),
        "steps = 0", "1 or more",
    ),
    "an empty batch": (
        lambda g: learner().fit(torch.zeros(2, 1, 14, 14), range(1), 0, batch=0),
        "batch = 0", "1 or more",
    ),
    "wide patches": (
        lambda g: learning.Patches(torch.zeros(1, 1, 9, 9), 20, 3, torch.Generator()),
        "20 wide", "give less",
    ),
    "detectors in a list": (
        lambda g: detector.ObjectDetector.load("rig", ["best"]), "['best']", "choose from"
    ),
    "rounds in words": (
        lambda g: g.model.detector.regress(g.image, BOX, "all"), "'all'", "whole number"
    ),
    "features by name": (
        lambda g: recipes.Recipe(features="colours").describe(g.image, BOX), "'colours'", "none of"
    ),
    "half a cell": (lambda g: features.gradients(g.image, BOX, 2.5), "cells = 2.5", "1 or more"),
    "the context of a photo": (
        lambda g: features.pixels_in_context(g.photo, BOX), "Photo(…)", "read_image"
    ),
    "localisers in a list": (lambda g: localiser.Localiser.load(["rig"]), "['rig']", "or names"),
    "photographs to fit": (
        lambda g: localiser.Localiser.fit(photos.load("real", "train"), RNG),
        "real/train/001", 'load("rig", "train")',
    ),
    "no photos to fit": (lambda g: localiser.Localiser.fit([], RNG), "[]", 'load("rig", "train")'),
    "a scale in words": (lambda g: segmentation.segment(NOISE, "fine"), "'fine'", "above 0"),
    "a list of scales": (lambda g: segmentation.segment(NOISE, [5, 9]), "[5, 9]", "above 0"),
    "one scale": (lambda g: next(segmentation.segmentations(NOISE, 100)), "100", "give a list"),
    "scales of a strategy": (
        lambda g: selective_search.Strategy(k=("fine",)), "('fine',)", "give numbers"
    ),
    "a measure alone": (
        lambda g: selective_search.Strategy(similarities=("colour",)), "'colour'", "('colour',)"
    ),
    "strategies in a list": (
        lambda g: selective_search.propose(g.image, ["single"]), "['single']", "single, fast"
    ),
    "a seed in words": (lambda g: selective_search.propose(NOISE, rng="x"), "rng 'x'", "a seed"),
    "a negative seed": (lambda g: selective_search.propose(NOISE, rng=-1), "rng -1", "0 or more"),
    "pixels in words": (
        lambda g: selective_search.rank_boxes([], RNG, "20 px"), "'20 px'", "as 20"
    ),
    "no trees": (lambda g: selective_search.rank_boxes([], RNG), "no hierarchy", "one or more"),
    "a seed for ranks": (lambda g: selective_search.rank_boxes([], 0), "rng 0", "default_rng"),
    "a strategy's name": (
        lambda g: next(selective_search.hierarchies(BLANK, "single")), "'single'", "STRATEGIES"
    ),
    "merges too many": (lambda g: tree().after(99), "steps = 99", "0 merges"),
    "labels of floats": (
        lambda g: selective_search.adjacent_regions(NOISE[0]), "float64", "segment(…)"
    ),
    "three classes": (
        lambda g: svm.KernelSVM.fit(np.eye(3), [0, 1, 2]), "[0, 1, 2]", "true and false"
    ),
    "no labels": (lambda g: svm.KernelSVM.fit(np.eye(2), None), "labels ()", "n labels"),
    "features of NaN": (
        lambda g: svm.KernelSVM.fit([[np.nan, 1], [1, 0]], [0, 1]), "nan", "give finite"
    ),
    "features all alike": (
        lambda g: svm.KernelSVM.fit(np.ones((2, 2)), [0, 1]), "variance 0.0", "that differ"
    ),
    "kernels in a list": (
        lambda g: svm.KernelSVM.fit(np.eye(2), [0, 1], ["rbf"]), "['rbf']", "linear, poly"
    ),
    "a score of other features": (
        lambda g: svm.KernelSVM.fit(np.eye(2), [0, 1]).score(np.ones((1, 5))), "(1, 5)", "(n, 2)"
    ),
    "a seed for centres": (
        lambda g: box_regression.RBFRidge.fit(np.eye(2), np.eye(2), 1, 0), "rng 0", "default_rng"
    ),
    "a place outside": (
        lambda g: loop.locate(g.model, g.image, [900, 900, 950, 950], g.photo.camera),
        "[900, 900, 950, 950]", "600×400",
    ),
    "a photo of no name": (lambda g: photos.read_image(""), "is a folder", "name a file in it"),
    "a network's level": (lambda g: cdbn.CDBN.load("rig"), "'rig'", "write CDBN.load()"),
}  # fmt: skip
MOVING = {
    "a target in the plane": (lambda g: loop.reach(g.model, (0.1, -0.4)), "[ 0.1 -0.4]", "in m"),
    "a far target": (lambda g: loop.reach(g.model, (3, 0, 0)), "[3. 0. 0.]", "move the target"),
    "no number": (lambda g: loop.reach(g.model, (np.nan, 0, 0)), "[nan", "must be finite"),
    "a rule": (lambda g: loop.reach(g.model, g.photo.target, "best"), "'best'", "'published'"),
    "a rule, again": (lambda g: loop.recalibrate(g.reach, "exact"), "'exact'", "'published'"),
    "no camera": (
        lambda g: loop.locate(g.model, g.image, g.photo.boxes["shuttlecock"], None),
        "camera is unknown", "give the photo's Camera",
    ),
    "degrees": (lambda g: arm_scene((0, 130)), "130.", "np.radians(degrees)"),
    "joints apart": (lambda g: arm_scene(0, 1), "posture 0", "2 numbers in a tuple"),
    "no joints": (lambda g: arm_scene(g.plan), "posture Plan(", "give numbers"),
    "three joints": (lambda g: arm_scene((0, 1, 2)), "(3,)", "give 2 numbers"),
    "five muscles": (lambda g: arm_scene((0, 1), (0,) * 5), "(5,)", "give 6 numbers"),
    "a ball in the plane": (
        lambda g: arm_scene((0, 1), balls=[((0.1, 0.2), "red")]), "(0.1, 0.2)", "give 3 numbers"
    ),
    "a ball's colour": (
        lambda g: arm_scene((0, 1), balls=[((0.1, 0, 0), "teal")]), "'teal'", "choose from blue"
    ),
    "a start in degrees": (lambda g: excite(0.1, (0, 90)), "90.", "np.radians(degrees)"),
    "five excitations": (lambda g: excite(0.1, muscles=5), "(10, 5)", "use (T, 6)"),
    "too much excitation": (lambda g: excite(2.0), "[0, 2]", "clip them to [0, 1]"),
    "three levels": (
        lambda g: simulate.constant_excitation((0, 0, 0), 1), "(3,)", "each of the 6 muscles"
    ),
    "a duration": (
        lambda g: simulate.constant_excitation(6 * (0,), -1), "-1 s", "choose at least 0.001 s"
    ),
    "a load": (lambda g: arm26.model_with_load(-3), "-3 kg", "choose 0 to 10"),
    "one joint": (lambda g: arm26.geometry((0,)), "(0,)", "(shoulder, elbow), in rad"),
    "a posture": (lambda g: dynamics.hand((0, 1, 2)), "(0, 1, 2)", "(shoulder, elbow)"),
    "a place": (lambda g: kinematics.inverse_kinematics((3, 0)), "[3. 0.]", "move the target"),
    "no template near": (
        lambda g: planning.plan((2, 2), g.model.template_set), "[2. 2.]", "move it inside them"
    ),
    "a rule of planning": (
        lambda g: planning.plan((0.1, -0.38), g.model.template_set, rule="Eq. 4"),
        "'Eq. 4'", "choose from 'habitual', 'exact'",
    ),
    "no plan": (lambda g: execution.execute([0.1, -0.4]), "[0.1, -0.4]", "what plan(target, te"),
    "a load for a perturbation": (
        lambda g: execution.execute(g.plan, 1.0), "perturbation 1.0", "give Perturbation(load=1.0)"
    ),
    "a prism of words": (lambda g: execution.execute(g.plan, prism="a"), "'a' rad", "give radians"),
    "a prism in degrees": (lambda g: execution.execute(g.plan, prism=30), "30 rad", "give radians"),
    "templates first": (
        lambda g: planning.plan(g.model.template_set, (0.1, -0.38)),
        "(0.1, -0.38)", "templates.load()",
    ),
    "a model for templates": (
        lambda g: planning.plan((0.1, -0.38), g.model), "VisuomotorModel(", "templates.load()"
    ),
    "a target of words": (
        lambda g: planning.plan("left", g.model.template_set), "'left'", "give numbers"
    ),
    "rows without a target": (
        lambda g: planning.plan((0.1, -0.38), g.model.template_set, rows=[[0], [1]]),
        "(2, 1)", "give (N,)",
    ),
    "another row": (
        lambda g: planning.plan((0.1, -0.38), g.model.template_set, rows=[99]), "[99]", "0 to 18"
    ),
    "three weights": (lambda g: g.plan.with_weights([1, 0, 0]), "[1.0, 0.0, 0.0]", "each of 4"),
    "a target in space": (
        lambda g: planning.nearest((0.1, -0.4, 0), g.plan.points, 2), "0. ]", "points (4, 2)"
    ),
    "a seed for targets": (
        lambda g: planning.draw_targets(g.model.template_set, 3, 0), "rng 0", "default_rng(seed)"
    ),
    "a seed for boxes": (lambda g: boxes.jitter_boxes([[0, 0, 9, 9]], 0.1, 1), "rng 1", "default_"),
    "a plan to recalibrate": (
        lambda g: loop.recalibrate(g.plan, "own"), "Plan(", "what loop.reach(model, target)"
    ),
    "no batch": (lambda g: online.WeightCorrection().update(g.plan), "is no batch", "plan for tar"),
    "targets to correct": (
        lambda g: online.WeightCorrection().correct(np.zeros((3, 2))), "array(3, 2)", "what plan("
    ),
    "a rule of learning": (
        lambda g: online.WeightCorrection().update(g.plans, "exact"), "'exact'", "'published'"
    ),
    "one gain": (lambda g: offline.algorithm_1(g.plan, 5), "gains = 5", "as range(21)"),
    "half a trial": (lambda g: offline.broyden_calibration(g.plan, 2.5), "= 2.5", "a whole number"),
    "a Jacobian of joints": (
        lambda g: offline.broyden_calibration(g.plan, jacobian=np.eye(3)), "(3, 3)", "give (D, N)"
    ),
    "lessons of another length": (
        lambda g: online.GranuleCells().fit(np.zeros((3, 2)), np.zeros(2)), "(2,)", "give (n, d)"
    ),
    "a width of nothing": (
        lambda g: online.GranuleCells(0).fit(np.zeros((3, 2)), np.zeros(3)), "of 0", "above 0"
    ),
    "a plan to feed back": (
        lambda g: feedback.simulate_feedback(g.plans), "Plan(", "give reference_trajectory(plan)"
    ),
    "a plan to correct": (
        lambda g: feedback_error.FeedbackErrorLearning(g.model.template_set).correct(g.plans),
        "Plan(", "give reference_trajectory(plan)",
    ),
    "a strength": (lambda g: forward_model.arm_copy("strong"), "'strong'", "give numbers"),
    "one movement": (
        lambda g: forward_model.ForwardModel().update(g.reach.planned), "q=array(", "give a batch"
    ),
    "duration and level": (
        lambda g: simulate.constant_excitation(1.0, 6 * [0]), "[0, 0, 0, 0", "choose at least"
    ),
    "a load in words": (lambda g: arm26.model_with_load("heavy"), "'heavy' kg", "choose 0 to 10"),
    "a place in the plane": (
        lambda g: kinematics.to_world([0.1, -0.4], 0.1), "[ 0.1 -0.4]", "of shape (…, 3), in m"
    ),
    "a hold": (lambda g: templates.load(hold="long"), "'long' s", "give seconds"),
    "templates": (lambda g: templates.load(4), "4 m apart", "choose one of (0.04"),
    "a plan, a rule's place": (
        lambda g: offline.calibrate(offline.algorithm_1, g.plan), "is no Plan", "give what plan("
    ),
    "a name for a photo": (lambda g: arm_scene((0, 1), photo="rig"), "'rig'", "photos.load("),
    "one ball": (
        lambda g: arm_scene((0, 1), balls=(0.1, 0, 0)), "0.1 is no pair", "colour name)"
    ),
    "an end of three": (
        lambda g: arm_scene((0, 1), balls=[((0.1, 0, 0), "red")], end=(0, 0, 0)),
        "(0, 0, 0) is no pair", "speed)",
    ),
    "an end without its target": (
        lambda g: arm_scene((0, 1), balls=[((0.1, 0, 0), "red")], end=((0.2, 0, 0), 1)),
        "((0.2, 0, 0), 1)", "as a green ball",
    ),
    "no end": (lambda g: arm_scene((0, 1), end=()), "end () is no pair", "speed)"),
    "a turn": (lambda g: arm_scene((0, 1), turn="left"), "'left'", "give numbers"),
    "a muscle": (
        lambda g: simulate.simulate(np.zeros((9, 6)), (0, 1), muscle="Hill"),
        "'Hill'", "two functions",
    ),
    "a share of noise": (
        lambda g: muscle.noisy(0.5, "some", np.random.default_rng(0)), "'some'", "0 or more"
    ),
    "six excitations": (lambda g: templates.reach(np.zeros(6)), "(6,)", "(…, T, 6)"),
    "weights of a rule": (
        lambda g: planning.plan((0.1, -0.38), g.model.template_set, lambda target, points: 1),
        "weights 1", "return them as (4,)",
    ),
    "a ragged posture": (lambda g: dynamics.hand(RAGGED), "[[1, 2], [3]]", "rows of a length"),
    "a ragged torque": (
        lambda g: dynamics.forward_dynamics([0, 1], [0, 0], RAGGED), "[[1, 2], [3]]", "of a length"
    ),
    "ragged limits": (lambda g: dynamics.check_posture(RAGGED), "[[1, 2], [3]]", "of a length"),
    "a ragged drawing": (lambda g: arm26.geometry(RAGGED), "[[1, 2], [3]]", "rows of a length"),
    "ragged excitations": (lambda g: templates.reach(RAGGED), "[[1, 2], [3]]", "rows of a length"),
    "ragged rows": (
        lambda g: planning.plan((0.1, -0.38), g.model.template_set, rows=RAGGED),
        "[[1, 2], [3]]", "rows of a length",
    ),
    "ragged gains": (
        lambda g: offline.algorithm_1(g.plan, RAGGED), "[[1, 2], [3]]", "rows of a length"
    ),
    "no templates for silence": (
        lambda g: adaptation.silent_endpoint(None), "template_set None", "load()"
    ),
    "a velocity of another arm": (
        lambda g: forward_model.state_inputs([0, 1], [0, 0, 0], np.zeros(6)), "(3,)", "each joint"
    ),
    "an arm that returns nothing": (
        lambda g: offline.algorithm_1(g.plan, execute=lambda _: None), "None", "execute, or"
    ),
    "an arm that returns its plan": (
        lambda g: offline.broyden_calibration(g.plan, execute=lambda plan: plan),
        "Plan(", "execute, or",
    ),
    "an arm that tells its error": (
        lambda g: offline.gauss_newton_calibration(g.plan, execute=lambda _: 0.1),
        "0.1", "execute, or",
    ),
    "ragged points": (
        lambda g: planning.habitual_weights((0.1, -0.4), [[0.1, -0.3], [0.2]]),
        "[[0.1, -0.3], [0.2]]", "in rows of a length",
    ),
    "a time in words": (
        lambda g: feedback.reference_trajectory(g.plans, "long"), "'long' s", "1 s or more"
    ),
    "a gain alone": (
        lambda g: feedback.simulate_feedback(reference(g), 30.0), "30.0", "SIGHT._replace("
    ),
    "a model's name": (
        lambda g: feedback.simulate_feedback(reference(g), model="copy"), "'copy'", "arm_copy()"
    ),
    "a disturbance": (
        lambda g: feedback.simulate_feedback(reference(g), disturbance=3.0), "3.0", "curl(strength)"
    ),
    "noise in words": (
        lambda g: feedback.simulate_feedback(reference(g), noise="some"), "'some'", "0 or more"
    ),
    "a seed for noise": (
        lambda g: feedback.simulate_feedback(reference(g), noise=0.1, rng=0), "rng 0", "default_rng"
    ),
    "a force in space": (lambda g: feedback.push((1, 2, 3), 0.2), "[1. 2. 3.]", "arm's plane"),
    "a curl": (lambda g: feedback.curl("strong"), "'strong'", "give numbers"),
    "a plan to switch to": (
        lambda g: feedback.switch(reference(g), g.plan, 0.2), "Plan(", "reference_trajectory(plan)"
    ),
    "a regression that is new": (
        lambda g: online.LinearRegression().predict(np.zeros((1, 2))), "nothing yet", "fit it first"
    ),
    "a sign": (lambda g: offline.algorithm_1(g.plan, sign=2), "sign 2", "1 or -1"),
    "an origin": (lambda g: offline.algorithm_1(g.plan, origin=3), "origin 3", "(x, y) in m"),
    "a place first": (
        lambda g: g.reach.distance((0, 0, 0), g.reach.planned), "(0, 0, 0)", "reach.planned"
    ),
    "a goal in space": (
        lambda g: inverse_dynamics.minimum_jerk((0, 0), (1, 1, 1)), "[1. 1. 1.]", "of one length"
    ),
    "an angle alone": (lambda g: inverse_dynamics.minimum_jerk(0, 1), "goal 1.0", "(…, n)"),
    "samples before the start": (
        lambda g: inverse_dynamics.minimum_jerk((0, 0), (1, 1), samples=-1), "= -1", "1 or more"
    ),
    "no time to move": (
        lambda g: inverse_dynamics.minimum_jerk((0, 0), (1, 1), moving=0), "= 0", "above 0"
    ),
    "half of the time": (
        lambda g: inverse_dynamics.minimum_jerk_profile("half"), "'half'", "give numbers"
    ),
    "a path in space": (
        lambda g: inverse_dynamics.required_torque(np.zeros((5, 3))), "(5, 3)", "(T + 1, 2)"
    ),
    "a path of a moment": (
        lambda g: inverse_dynamics.required_torque([[0, 1]]), "(1, 2)", "two rows or more"
    ),
    "a speed of one joint": (
        lambda g: inverse_dynamics.muscle_gain((0, 1), (0,)), "(1,)", "give both as (…, 2)"
    ),
    "muscles of three joints": (lambda g: dynamics.paths((0, 1, 2)), "(0, 1, 2)", "elbow), (…, 2)"),
    "muscles by name": (lambda g: dynamics.paths("bent"), "bent", "(shoulder, elbow), (…, 2)"),
    "a power": (
        lambda g: planning.exact_weights((0.1, -0.4), g.plan.points, "two"), "'two'", "as 1 or 2"
    ),
    "a movement's name": (lambda g: g.reach.hand("planned"), "'planned'", "give reach.planned"),
    "an end by name": (lambda g: g.reach.endpoint("planned"), "'planned'", "give reach.planned"),
    "geometry in degrees": (lambda g: arm26.geometry((0, 90)), "90", "np.radians(degrees)"),
    "geometry of NaN": (lambda g: arm26.geometry((np.nan, 0)), "nan", "np.radians(degrees)"),
    "geometry in words": (lambda g: arm26.geometry(("a", "b")), "('a', 'b')", "give numbers"),
    "two loads": (lambda g: arm26.model_with_load([1]), "[[1]]", "give numbers or names"),
    "the inertia of a posture": (lambda g: arm26.mass_matrix((0, 1)), "(0, 1)", "forward(q)"),
    "dynamics of a number": (lambda g: arm26.dynamics_at(3), "()", "(n, 2)"),
    "a velocity in space": (
        lambda g: dynamics.torque_for((0, 1), (0, 0, 0), (0, 0)), "velocity", "each joint"
    ),
    "a torque alone": (
        lambda g: dynamics.forward_dynamics((0, 1), (0, 0), 1.0), "torque", "each joint"
    ),
    "a trunk's turn in words": (
        lambda g: kinematics.to_world([0, 0, 0], "left"), "turn 'left'", "give numbers"
    ),
    "an excitation in words": (lambda g: muscle.noisy("full", 0.1, RNG), "'full'", "numbers"),
    "a field in words": (
        lambda g: simulate.simulate(np.zeros((9, 6)), (0, 1), perturbation=field([["a"] * 2] * 2)),
        "'a'", "give numbers",
    ),
    "two loads in the hand": (
        lambda g: simulate.simulate(np.zeros((9, 6)), (0, 1), perturbation=field(load=[1])),
        "[1] kg", "choose 0 to 10",
    ),
    "levels of NaN": (
        lambda g: simulate.constant_excitation(6 * (np.nan,), 1), "[nan, nan]", "clip them"
    ),
    "levels in percent": (
        lambda g: simulate.constant_excitation(6 * (20,), 1), "[0, 20]", "clip them to [0, 1]"
    ),
    "a step in words": (
        lambda g: simulate.constant_excitation(6 * (0,), 1, "ms"), "'ms' s", "(0, 0.01] s"
    ),
    "no step": (lambda g: simulate.constant_excitation(6 * (0,), 1, 0), "of 0 s", "(0, 0.01] s"),
    "a posture of words": (lambda g: dynamics.check_posture(("a", "b")), "('a', 'b')", "numbers"),
    "a part of one plan": (lambda g: g.plan[0], "[ 0.1  -0.38]", "plan for targets (B, 2)"),
    "an eye in space": (
        lambda g: execution.rotate_about_eye((0, 0, 0), 0.1), "(3,)", "give (…, 2)"
    ),
    "spacings": (lambda g: templates.load([0.06]), "[[0.06]]", "give numbers or names"),
    "a negative hold": (lambda g: templates.keep_last(np.zeros((9, 6)), -1), "-1 s", "0 or more"),
    "a hold of NaN": (lambda g: templates.reach(np.zeros((9, 6)), hold=np.nan), "nan s", "0 or m"),
    "a switch in words": (
        lambda g: feedback.switch(reference(g), reference(g), "now"), "'now'", "give numbers"
    ),
    "a switch to a longer one": (
        lambda g: feedback.switch(reference(g), feedback.reference_trajectory(g.plans), 0.2),
        "(2, 2001, 2)", "of one length",
    ),
    "gains in words": (lambda g: corrected(g, gain="high"), "'high'", "give numbers"),
    "no delay": (lambda g: corrected(g, delay=None), "delay=None", "give finite numbers"),
    "two delays": (lambda g: corrected(g, delay=[0.1, 0.2]), "[0.1, 0.2]", "finite numbers"),
    "a law's name": (lambda g: corrected(g, law="PD"), "'PD'", "SIGHT's"),
    "a push in words": (
        lambda g: feedback.simulate_feedback(
            reference(g), disturbance=feedback.Disturbance(force="hard")
        ),
        "'hard'", "give numbers",
    ),
    "a push at no time": (lambda g: feedback.push((1, 2), "now"), "'now'", "give numbers"),
    "three pushes of two": (
        lambda g: feedback.simulate_feedback(
            reference(g), disturbance=feedback.push(np.ones((3, 2)), 0.2)
        ),
        "(3, 2)", "forces (2, 2)",
    ),
    "two curls": (lambda g: feedback.curl([1, 2]), "[1.0, 2.0]", "give one number"),
    "few knots": (lambda g: inverse_dynamics.spline(2), "knots = 2", "4 or more"),
    "half a knot": (lambda g: inverse_dynamics.spline(28.5), "knots = 28.5", "4 or more"),
    "postures to hold": (
        lambda g: inverse_dynamics.static_activation([[0, 1]] * 3), "(3, 2)", "give one, (2,)"
    ),
    "a path of NaN": (
        lambda g: inverse_dynamics.required_torque(np.full((5, 2), np.nan)), "NaN", "needs finite"
    ),
    "nothing trained": (
        lambda g: adaptation.Adaptation(None, g.model.template_set), "None", "an AimCorrection"
    ),
    "a share in words": (lambda g: adapting(g, regularisation="some"), "'some'", "more than 0"),
    "a whole share": (lambda g: adapting(g, regularisation=0), "= 0", "more than 0"),
    "no plan to adapt": (lambda g: adapting(g).correct(None), "plan None", "plan(target, te"),
    "one plan to adapt": (lambda g: adapting(g).correct(g.plan), "[ 0.1  -0.38]", "is no batch"),
    "errors of another": (
        lambda g: adaptation.minimum_norm_update(np.ones((2, 3)), np.ones((3, 2)), 0.3),
        "(3, 2)", "(n, cells)",
    ),
    "a shift in space": (
        lambda g: adaptation.weight_correction(g.plan.points, (0, 0, 0)), "shift", "(…, 2)"
    ),
    "no motion to learn": (
        lambda g: feedback_error.FeedbackErrorLearning(g.model.template_set).update(
            reference(g), None
        ),
        "motion None", "simulate_feedback(reference)",
    ),
    "another motion": (
        lambda g: feedback_error.FeedbackErrorLearning(g.model.template_set).update(
            reference(g), g.reach.planned
        ),
        "(1501, 2)", "simulate_feedback made",
    ),
    "a motion of plans": (
        lambda g: forward_model.ForwardModel().update(g.plans), "Plan(…)", "execute(plans).motion"
    ),
    "gains by name": (lambda g: offline.algorithm_1(g.plan, ["a"]), "['a']", "give numbers"),
    "an origin in words": (
        lambda g: offline.algorithm_1(g.plan, origin=("a", "b")), "('a', 'b')", "give numbers"
    ),
    "a law of change": (
        lambda g: offline.algorithm_1(g.plan, change="Eq. 6"), "'Eq. 6'", "algorithm_1_change"
    ),
    "an arm's name": (lambda g: offline.algorithm_1(g.plan, execute="arm"), "'arm'", "execute, or"),
    "a reach for an arm": (
        lambda g: offline.broyden_calibration(g.plan, execute=g.reach), "Reach(…)", "execute, or"
    ),
    "how many cells": (
        lambda g: online.AimCorrection(g.model.template_set, 600), "cells 600", "GranuleCells()"
    ),
    "another neighbour": (
        lambda g: online.AimCorrection(g.model.template_set, neighbours=[[0, 1, 2, 99]]),
        "99", "rows of templates",
    ),
    "a ridge in words": (
        lambda g: online.GranuleCells(ridge="little").fit(np.eye(2), np.eye(2)), "'little'", "0 or"
    ),
    "a negative ridge": (
        lambda g: online.GranuleCells(ridge=-1).fit(np.eye(2), np.eye(2)), "of -1", "0 or more"
    ),
    "lessons of another kind": (
        lambda g: cells().partial_fit(np.eye(2), np.ones((2, 3))), "(2, 3)", "give (2, 2)"
    ),
    "more lessons than inputs": (
        lambda g: cells().partial_fit(np.eye(2), np.ones((3, 2))), "(3, 2)", "give (2, 2)"
    ),
    "lines of another length": (
        lambda g: online.LinearRegression().fit(np.eye(2), np.ones((3, 2))), "(3, 2)", "(n, k)"
    ),
    "lines at other features": (
        lambda g: online.LinearRegression().fit(np.eye(2), np.eye(2)).predict(np.ones((1, 5))),
        "(1, 5)", "rows of 2 features",
    ),
    "a target's inputs": (lambda g: online.mossy_fibres((0.1, -0.4)), "(0.1, -0.4)", "plan(targ"),
    "no plan's inputs": (lambda g: online.equation_8(None), "plan None", "plan(target"),
    "rates in a pair": (lambda g: two_rates.adapt([1], (0.6, 0.2)), "(0.6, 0.2)", "Rates(kept="),
    "three memories": (
        lambda g: two_rates.adapt([1], two_rates.Rates(kept=(0.6, 0.9, 0.99))), "0.9,", "two of"
    ),
    "a hand in degrees": (lambda g: dynamics.hand((0, 60)), "60", "np.radians(degrees)"),
    "muscles in degrees": (lambda g: dynamics.paths((0, 60)), "60", "np.radians(degrees)"),
    "torques in degrees": (
        lambda g: dynamics.torque_for((0, 90), (0, 0), (0, 0)), "90", "np.radians(degrees)"
    ),
    "accelerations in degrees": (
        lambda g: dynamics.forward_dynamics((0, 90), (0, 0), (0, 0)), "90", "np.radians(degrees)"
    ),
    "a path in degrees": (
        lambda g: inverse_dynamics.minimum_jerk((0, 30), (0, 60), 100), "30", "np.radians(degrees)"
    ),
    "a goal in degrees": (
        lambda g: inverse_dynamics.minimum_jerk((0, 1), (0, 60)), "60", "np.radians(degrees)"
    ),
    "MuJoCo in degrees": (lambda g: arm26.forward((0, 90)), "90", "np.radians(degrees)"),
    "a muscle in words": (lambda g: muscle.force("a", 1, 0, 1), "activation 'a'", "give numbers"),
    "a speed's text": (lambda g: muscle.force_velocity("x"), "velocity 'x'", "give numbers"),
    "less than no activation": (lambda g: muscle.force(-1, 1, 0, 1), "[-1, 0]", "clip them to [0"),
    "a named activation": (
        lambda g: muscle.force(activation=2, length=1, velocity=0, maximum=1), "[0, 2]", "clip them"
    ),
    "more than all excitation": (
        lambda g: muscle.activation_rate(3, 0.1), "excitation: values in [0, 3]", "clip them"
    ),
    "an activation of NaN": (lambda g: muscle.activation_rate(1, np.nan), "nan", "clip them"),
    "a step back": (lambda g: muscle.euler_activation(0.5, 0.1, -1), "-1 s", "above 0"),
    "a law that returns nothing": (
        lambda g: offline.algorithm_1(g.plan, [1], change=lambda *a: None),
        "None, a NoneType", "Δw, an array (4,)",
    ),
    "a law of one number": (
        lambda g: offline.algorithm_1(g.plan, [1], change=lambda *a: 0.1),
        "<lambda> returned 0.1", "Δw, an array (4,)",
    ),
    "gains of NaN": (
        lambda g: offline.algorithm_1(g.plan, [np.nan]), "gains = [nan]", "finite numbers"
    ),
    "no target to weigh for": (
        lambda g: planning.habitual_weights((np.nan, 0), g.plan.points), "(nan, 0)", "give finite"
    ),
    "no target to be exact about": (
        lambda g: planning.exact_weights((np.nan, 0), g.plan.points), "(nan, 0)", "give finite"
    ),
    "nearest to nothing": (
        lambda g: planning.nearest((np.nan, 0), g.plan.points, 2), "(nan, 0)", "give finite"
    ),
    "a plan of three weights": (
        lambda g: execution.execute(replace(g.plan, weights=np.full(3, 0.3))),
        "weights (3,) and rows (4,)", "give plan.with_weights(",
    ),
    "a push of NaN": (lambda g: feedback.push([np.nan, 2], 1), "[nan, 2.0] N", "finite"),
    "a push before the start": (lambda g: feedback.push([1, 2], -1), "at -1.0 s", "0 s or later"),
    "a curl of NaN": (lambda g: feedback.curl(np.nan), "nan N s / m", "finite"),
    "a number in quotes": (
        lambda g: muscle.force_velocity("1"), "velocity '1'", "give numbers"
    ),
    "a target in quotes": (
        lambda g: planning.plan(["0.1", "-0.38"], g.model.template_set), "['0.1'", "give numbers"
    ),
    "an imaginary velocity": (lambda g: muscle.force_velocity(1j), "velocity 1j", "give numbers"),
}  # fmt: skip
SHOWING = {
    "one draw": (lambda g: statistics.t_interval([1.0]), "1 values", "give two or more"),
    "a share": (lambda g: statistics.wilson(5, 3), "5 of 3", "give counts"),
    "no list": (lambda g: statistics.t_interval(3.0), "1 values", "give two or more"),
    "ragged answers": (lambda g: statistics.mcnemar(RAGGED, [1]), "[[1, 2], [3]]", "of a length"),
    "other answers": (lambda g: statistics.mcnemar([1, 0], [1]), "(1,)", "the same questions"),
    "no draws": (lambda g: estimate([]), "0 values", "give two or more"),
    "a row": (lambda g: table(["a", "b"], [[1]]), "the row [1]", "2 cells"),
    "a head": (lambda g: table(["a", ""], [[1, 2]]), "['a', '']", "needs a head"),
    "a colour": (lambda g: COLOURS["teal"], "'teal'", "choose from blue"),
    "a box on a photo": (
        lambda g: photo_view(g.image, [((1, 2, 3), "a", "blue")]), "((1, 2, 3)", "give ((x0, y0"
    ),
    "a label first": (
        lambda g: photo_view(g.image, points=[("a", (1, 2), "blue")]), "('a',", "give ((x, y), la"
    ),
    "a name of a photo": (lambda g: photo_view("a.jpg"), "'a.jpg'", "photos.read_image"),
    "a unit as a start": (lambda g: Slider([1, 2], "k", "m"), "'m'", "unit='m'"),
    "a number of values": (lambda g: Slider(5, "k"), "the values 5", "as range(6)"),
    "one label": (lambda g: Pad([0, 1], [0, 1], ("x",)), "('x',)", "two labels"),
    "lines drawn": (lambda g: figure([1]), "list", "return `ax`"),
    "a photo drawn": (lambda g: figure(g.photo), "Photo", "give photo.image"),
    "up and down": (lambda g: Slider([1, 3, 2]), "['1', '3', '2']", "in order"),
    "a value of words": (
        lambda g: setattr(widget(text, k=(0, 3)), "value", {"k": "x"}), "'x'", "it has 0, 1, 2, 3"
    ),
    "nothing drawn": (lambda g: explore(lambda k: None, k=(0, 3)), "NoneType", "`return fig`"),
    "a number drawn": (lambda g: figure(3), "int", "return a matplotlib Figure"),
    "another argument": (lambda g: explore(text, b=(0, 3)), "controls are b", "takes (k)"),
    "plain words drawn": (lambda g: figure("plain"), "str", "`note(text)`"),
    "a control without a name": (lambda g: explore(text, (0, 3)), "(0, 3)", "k=(0, 10)"),
    "a caption first": (lambda g: explore("caption", text), "'caption'", "then a caption"),
    "a scene and a pad": (
        lambda g: explore(lambda k: arm_scene((0, k[0])), alt="an arm", k=Pad([0, 1], [0.5, 1])),
        "'x and y'", "return (figure, scene)",
    ),
    "a series": (lambda g: compare([1, 2], "mm"), "[1, 2]", "{label: {row: draws}}"),
    "rows": (lambda g: compare({"ours": [1, 2]}, "mm"), "'ours' is [1, 2]", "{label: {row"),
    "an exercise": (lambda g: grade(text, "exercise"), "'exercise'", "book.exercises"),
    "a number in a sentence": (
        lambda g: explore(text, k=(0, 3))["recall #"], "'recall #'", "has the sliders k"
    ),
    "chances": (lambda g: statistics.holm("few"), "'few'", "give numbers"),
    "an estimate in words": (lambda g: estimate("few"), "'few'", "give numbers"),
    "an interval alone": (lambda g: estimate((1, 2)), "(1, 2)", "(value, low, high)"),
    "no rows": (lambda g: table(["a"], 3), "rows 3", "a list of rows"),
    "a row of one number": (lambda g: table(["a", "b"], {"ours": 1}), "{'ours': 1}", "a list of r"),
    "a note of a number": (lambda g: note(3), "note 3", "str(…)"),
    "boxes in a row": (lambda g: photo_view(g.image, [1, 2, 3, 4]), "hold 1", "give ((x0, y0"),
    "an exercise to solve": (lambda g: solution(text), "exercise <function", "book.exercises"),
    "one start": (lambda g: Pad([0, 1], [0, 1], start=5), "5", "two starts"),
    "labels of values": (lambda g: Slider([0, 1], labels=["a"]), "['a']", "one for each"),
    "a switch": (lambda g: Switch("on"), "('o', 'n')", "give (False, True)"),
    "a control as an attribute": (
        lambda g: setattr(widget(text, k=(0, 3)), "k", 2), "'k': 2", "write demo.value = {"
    ),
    "no freedom": (lambda g: statistics.t_quantile(0), "n = 0", "1 or more"),
    "half a freedom": (lambda g: statistics.t_quantile(2.5), "n = 2.5", "whole number"),
    "answers in words": (
        lambda g: statistics.mcnemar(["no", "yes"], ["yes", "no"]), "['no', 'yes']", "True or False"
    ),
    "answers in numbers": (lambda g: statistics.mcnemar([3, 4], [1, 0]), "[3, 4]", "True or False"),
    "chances in a square": (
        lambda g: statistics.holm([[0.1, 0.2], [0.3, 0.4]]), "[[0.1, 0.2], [0.3, 0.4]]", "p-values"
    ),
    "a chance of NaN": (lambda g: statistics.holm([np.nan, 0.1]), "nan", "0 to 1"),
    "a chance in percent": (lambda g: statistics.holm([5, 1]), "[5.0, 1.0]", "0 to 1"),
    "published in a list": (
        lambda g: compare({"ours": {"a": [1, 2]}}, "mm", published=[3]), "[3]", "{row: number}"
    ),
    "one limit": (lambda g: compare({"ours": {"a": [1, 2]}}, "mm", xlim=3), "xlim 3", "(low, h"),
    "nothing to compare": (lambda g: compare({}, "mm"), "series []", "one label or more"),
    "a row of nothing": (lambda g: compare({"ours": {"a": None}}, "mm"), "None", "give numbers"),
    "an interval in words": (lambda g: estimate(("a", "b", "c")), "('a', 'b', 'c')", "numbers"),
    "boxes in a number": (lambda g: photo_view(g.image, 3), "boxes are 3", "give a list"),
    "no heads": (lambda g: table(None, [[1, 2]]), "heads None", "a list of texts"),
    "nothing expected": (lambda g: check("1/2", None), "expected None", "give what is right"),
    "a tolerance": (lambda g: check("1/2", 0.5, "a bit"), "'a bit'", "and a number"),
    "a pad of names": (lambda g: Pad(["a", "b"], [0, 1]), "['a', 'b']", "give numbers"),
    "balls in a number": (lambda g: arm_scene((0, 1), balls=3), "balls 3", "give a list"),
    "turns of another": (lambda g: arm_scene((0, 1), turn=60 * (0,)), "turn (60,)", "or one"),
    "activations of another": (
        lambda g: arm_scene(np.zeros((40, 2)), np.zeros((100, 6))), "(100, 6)", "or one"
    ),
    "an end in words": (
        lambda g: arm_scene((0, 1), balls=[((0.1, 0, 0), "green")], end=("here", 1)),
        "'here'", "give numbers",
    ),
    "a speed in words": (
        lambda g: arm_scene((0, 1), balls=[((0.1, 0, 0), "green")], end=((0, 0, 0), "fast")),
        "'fast'", "m/s",
    ),
    "movements in a scene": (
        lambda g: arm_scene(execution.execute(g.plans).motion), "a batch", "list(motion)[0]"
    ),
    "a view from a plane": (lambda g: Scene().look((1, 2), (0, 0, 0)), "(1, 2)", "(x, y, z)"),
    "a value of nothing": (
        lambda g: setattr(widget(text, k=(0, 3)), "value", None), "value = None", "a dictionary"
    ),
    "an array for a value": (
        lambda g: setattr(widget(text, k=(0, 3)), "value", {"k": np.arange(2)}), "array", "0, 1, 2"
    ),
    "a pad at one number": (
        lambda g: setattr(pointed(g), "value", {"p": 210}), "stand at 210", "give both, (x, y)"
    ),
    "a pad at three": (
        lambda g: setattr(pointed(g), "value", {"p": (1, 2, 3)}), "(1, 2, 3)", "give both, (x, y)"
    ),
    "a control to observe": (
        lambda g: widget(text, k=(0, 3)).observe(print, "k"), "'k'", "observe 'value'"
    ),
    "a menu of nothing": (
        lambda g: widget(text, k=Dropdown(options=[])), "k=Dropdown", "give two or more"
    ),
    "one place on paper": (lambda g: widget(text, k=(0, 3), printed=3), "printed=3", "a list of"),
    "a number of more": (lambda g: widget(text, k=(0, 3), more=3), "more=3", "a list of names"),
    "a draw of NaN": (lambda g: statistics.t_interval([1, np.nan]), "nan", "finite numbers"),
    "a share for a count": (lambda g: statistics.wilson(0.5, 1), "0.5 of 1", "give counts"),
    "a slider along a word": (lambda g: Slider("abc", "x"), "'abc'", "as range(6)"),
}  # fmt: skip
CALLS = SIGHT | MOVING | SHOWING


def test_no_name_stands_twice_and_there_are_over_a_hundred():
    assert len(CALLS) == len(SIGHT) + len(MOVING) + len(SHOWING) >= 330


@pytest.mark.parametrize(("call", "value", "remedy"), CALLS.values(), ids=CALLS)
def test_a_wrong_call_is_told_the_value_and_the_remedy(call, value, remedy):
    with pytest.raises(ValueError, match=r"\w") as error:
        call(given())
    message = str(error.value)
    assert value in message
    assert remedy in message
