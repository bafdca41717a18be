"""Wrong calls of public functions: each is told what is wrong, with the value, and the remedy."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
import torch

from vmc_lib import box_selection, boxes, loop, photos, statistics
from vmc_lib.arm import arm26, dynamics, kinematics, muscle, simulate
from vmc_lib.cerebellum import feedback_error, forward_model, offline, online
from vmc_lib.motor import execution, feedback, inverse_dynamics, planning, templates
from vmc_lib.show import (
    COLOURS,
    Pad,
    Slider,
    Switch,
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
from vmc_lib.what import cdbn, crops, learning, recogniser
from vmc_lib.where import detector, segmentation, selective_search, svm


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
    "a size": (lambda g: photos.crops(g.image, [[0, 0, 5, 5]], -2), "-2×-2", "1 or more"),
    "a box of three": (lambda g: boxes.iou([[1, 2, 3]], [0, 0, 1, 1]), "(1, 3)", "(x0, y0, x1"),
    "a box inside out": (lambda g: boxes.iou([5, 5, 1, 1], [0, 0, 3, 3]), "[5. 5.", "x0 <= x1"),
    "too few scores": (lambda g: boxes.nms([[0, 0, 1, 1]], [0.3, 0.4]), "(2,)", "as many finite"),
    "an overlap": (lambda g: boxes.nms([[0, 0, 1, 1]], [0.3], 3), "overlap = 3", "within 0..1"),
    "an empty box": (lambda g: crops.crop(g.image, (0, 0, 0, 0)), "[0 0 0 0]", "600×400"),
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
        lambda g: learning.Learner.random(-1, 1, 5, torch.Generator()), "-1 filters", "1 or more"
    ),
    "no photo": (lambda g: photos.boxes_of("rig", "cup"), "'rig'", "give one of load("),
    "a file to crop": (lambda g: crops.crop("a.jpg", (0, 0, 9, 9)), "'a.jpg'", "read_image"),
    "a photo to crop": (
        lambda g: g.model.recogniser.box_probability(g.photo, [[0, 0, 9, 9]]),
        "Photo(…)", "read_image",
    ),
    "a crop of three": (lambda g: crops.crop(g.image, (0, 0, 9)), "(1, 3)", "(x0, y0, x1, y1)"),
    "a file to segment": (lambda g: segmentation.segment("a.jpg"), "'a.jpg'", "photos.as_float"),
    "a margin": (lambda g: boxes.pad_boxes([0, 0, 9, 9], "wide"), "'wide'", "give numbers"),
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
    "none together": (
        lambda g: online.AimCorrection(g.model.template_set).update(g.plans, 0), "= 0", "1 or more"
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
}  # fmt: skip
SHOWING = {
    "one draw": (lambda g: statistics.student([1.0]), "1 values", "give two or more"),
    "a share": (lambda g: statistics.wilson(5, 3), "5 of 3", "give counts"),
    "no list": (lambda g: statistics.student(3.0), "1 values", "give two or more"),
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
    "a note of a number": (lambda g: note(3), "note 3", "str(…)"),
    "boxes in a row": (lambda g: photo_view(g.image, [1, 2, 3, 4]), "hold 1", "give ((x0, y0"),
    "an exercise to solve": (lambda g: solution(text), "exercise <function", "book.exercises"),
    "one start": (lambda g: Pad([0, 1], [0, 1], start=5), "5", "two starts"),
    "labels of values": (lambda g: Slider([0, 1], labels=["a"]), "['a']", "one for each"),
    "a switch": (lambda g: Switch("on"), "('o', 'n')", "give (False, True)"),
    "a control as an attribute": (
        lambda g: setattr(widget(text, k=(0, 3)), "k", 2), "'k': 2", "write demo.value = {"
    ),
}  # fmt: skip
CALLS = SIGHT | MOVING | SHOWING


def test_no_name_stands_twice_and_there_are_over_a_hundred():
    assert len(CALLS) == len(SIGHT) + len(MOVING) + len(SHOWING) >= 140


@pytest.mark.parametrize(("call", "value", "remedy"), CALLS.values(), ids=CALLS)
def test_a_wrong_call_is_told_the_value_and_the_remedy(call, value, remedy):
    with pytest.raises(ValueError, match=r"\w") as error:
        call(given())
    message = str(error.value)
    assert value in message
    assert remedy in message
