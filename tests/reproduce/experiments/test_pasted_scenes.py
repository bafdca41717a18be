import numpy as np
import pytest

from reproduce.experiments import pasted_scenes
from reproduce.training.scenes import SCENES
from vmc_lib.loop import VisuomotorModel
from vmc_lib.what.stream import MIN_PROBABILITY


@pytest.mark.parametrize("split", pasted_scenes.SPLITS)
def test_stored_answers_cover_every_scene(split):
    by_scene = pasted_scenes.load_results()[split]
    assert list(by_scene) == list(SCENES)
    for name, answers in by_scene.items():
        chance, fit = np.transpose(answers)
        assert len(answers) == pasted_scenes.COUNT
        assert ((chance >= 0) & (chance <= 1)).all()
        assert fit.max() <= (1 if SCENES[name][0] else 0)


def test_answers_are_counted_by_kind():
    by_scene = {"alone": [[0.9, 0.9], [0.9, 0.6], [0.9, 0.2], [0.1, 0.9]]}
    by_scene |= {"decoys alone": [[0.9, 0], [0.1, 0]]}
    counts = pasted_scenes.count_answers(by_scene, MIN_PROBABILITY)
    assert counts == {"alone": (2, 1, 1), "decoys alone": (0, 0, 1)}


def test_few_scenes_without_a_shuttlecock_raise_an_alarm():
    by_scene = pasted_scenes.load_results()["test"]
    empty = [name for name, (count, *_) in SCENES.items() if not count]
    counts = pasted_scenes.count_answers(by_scene, MIN_PROBABILITY)
    assert sum(counts[name][2] for name in empty) <= 0.1 * len(empty) * pasted_scenes.COUNT


def test_stored_answers_are_those_of_the_shipped_stream():
    stored = pasted_scenes.load_results()["validation"]["alone"][0]
    [photo] = pasted_scenes.pasted_photos("validation", count=1)[:1]
    [now] = pasted_scenes.answer_photos(VisuomotorModel.load("real"), [photo])
    assert now == pytest.approx(stored, abs=0.02)


def test_validation_and_test_scenes_differ():
    first, second = (
        pasted_scenes.pasted_photos(split, count=1)[0] for split in pasted_scenes.SPLITS
    )
    assert not (first.image == second.image).all()
