"""From a photo to the first movement: how long each stage takes, beside OpenCV's search alone."""

from tools.bench.report import publish, seconds
from tools.bench.selective_search import opencv_orders
from vmc_lib import loop, photos
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import plan


def stages(model, photo):
    """Every stage of the loop as a call of no arguments, in order."""
    regions = model.detector.detect(photo.image)
    sight = loop.see(model, photo.image)
    place = loop.locate(model, photo.image, sight.box, photo.camera)
    reach = loop.reach(model, place, calibration=None)
    return {
        "candidates and regions": lambda: model.detector.detect(photo.image),
        "names": lambda: model.recogniser.box_probability(photo.image, regions.boxes),
        "place": lambda: loop.locate(model, photo.image, sight.box, photo.camera),
        "turn and plan": lambda: plan(loop.turn_towards(place)[1], model.template_set).excitations,
        # anew each time: a movement is made once
        "first movement (simulated)": lambda: execute(reach.plan).motion,
        "off-line, published (21 movements)": lambda: algorithm_1(reach.plan),
        "off-line, own (2 movements)": lambda: broyden_calibration(reach.plan),
    }


if __name__ == "__main__":
    photo = photos.load("free", "validation")[1]
    peer = seconds(lambda: opencv_orders(photo.image, "fast"))
    times = {
        name: seconds(call)
        for name, call in stages(loop.VisuomotorModel.load("free"), photo).items()
    }
    first = dict(list(times.items())[:4])
    times["photo to first excitation"] = sum(first.values())
    publish(
        "loop",
        [{"stage": "OpenCV contrib's fast search alone", "ms": round(1e3 * peer, 1), "ratio": 1.0}]
        + [
            {"stage": name, "ms": round(1e3 * time, 1), "ratio": round(time / peer, 3)}
            for name, time in times.items()
        ],
    )
