from dataclasses import replace

import pytest

from reproduce import results
from reproduce.experiments import real_world
from reproduce.training.photographs import load_photographs
from vmc_lib import loop, photos


@pytest.mark.parametrize("split", real_world.SPLITS)
@pytest.mark.parametrize("model", real_world.MODELS)
def test_stored_answers_cover_every_photo(model, split):
    answers = real_world.load_results(model, split)
    shots = load_photographs(split)
    assert list(answers) == [photo.name for photo in shots]
    for photo, answer in zip(shots, answers.values(), strict=True):
        assert answer["holds"] == next(iter(photo.boxes), "neither")
    for question, (count, of) in real_world.count_answers(answers).items():
        kind = real_world.QUESTIONS[question][0]
        assert 0 <= count <= of == [answer["holds"] for answer in answers.values()].count(kind)


@pytest.mark.audit
@pytest.mark.parametrize("model", real_world.MODELS)
def test_stored_answers_are_reproducible(model):
    stored = real_world.load_results(model, "validation")
    first, *_, last = load_photographs("validation")  # with a shuttlecock, and with neither
    for photo in (first, last):
        now = real_world.examine(loop.VisuomotorModel.load(model), photo)
        then = stored[photo.name]
        assert now.pop("holds") == then["holds"]
        assert now.pop("chosen") == (then["chosen"] and pytest.approx(then["chosen"], abs=3))
        assert now == pytest.approx({key: then[key] for key in now}, abs=0.02)


@pytest.mark.audit
def test_chosen_box_may_match_any_shuttlecock():
    shot = photos.load("real", "train")[0]  # two shuttlecocks
    swapped = {"shuttlecock": shot.more[0]}
    other = replace(shot, boxes=swapped, more=shot.boxes["shuttlecock"][None])
    model = loop.VisuomotorModel.load("varied")
    one, two = (real_world.examine(model, photo) for photo in (shot, other))
    assert one["fit"] == two["fit"]
    assert one["kept"] != two["kept"]


def test_share_text_has_an_interval():
    assert real_world.share_text(1, 17) == "1 of 17 (1% to 27%)"


@pytest.mark.parametrize("model", real_world.MODELS)
def test_another_renderers_scenes_all_show_a_shuttlecock(model):
    answers = results.records("elsewhere")[model]
    assert len(answers) == 160
    counts = real_world.count_answers(answers)
    assert {of for _, of in counts.values()} == {160}
    assert {real_world.QUESTIONS[question][0] for question in counts} == {"shuttlecock"}


def test_choices_are_wrong_or_missing():
    box = [0, 0, 1, 1]
    results = [("shuttlecock", box, 0.9, 0.9), ("shuttlecock", box, 0.5, 0.9)]
    results += [("shuttlecock", None, 0, 0.6), ("shuttlecock", None, 0, 0.5), ("cup", box, 0, 0.9)]
    keys = ("holds", "chosen", "fit", "kept")
    answers = {k: dict(zip(keys, result, strict=True)) for k, result in enumerate(results)}
    assert real_world.count_choices(answers) == (1, 2, 1)
