"""From the pixels of a photo to the verdict: the page's eye says what Python's says."""

import numpy as np
import pytest

from tests.project import sample
from vmc_lib import photos
from vmc_lib.boxes import iou
from vmc_lib.loop import VisuomotorModel, see
from vmc_lib.marker_sheet import remove_sheet

SHEETS = photos.load("sheet", "test")[::4]
REAL = [*photos.load("real", "test")[::3], photos.everyday()[0]]
SOME = "sheet/test/000", "real/test/067"
SEE = """const stages = {};
  const report = (stage, { boxes }) => (stages[stage] = boxes);
  const { probability, box, summary } = await eye.see(brain, photo, { camera: asked, report });
  return { probability, box, summary, stages };"""


@pytest.fixture(scope="module")
def model():
    return VisuomotorModel.load("real")


@pytest.mark.browser
@pytest.mark.parametrize("shot", sample([*SHEETS, *REAL], *SOME), ids=lambda shot: shot.name)
def test_the_verdict_is_that_of_python(ask, model, shot):
    camera, image = remove_sheet(shot.image) if shot in SHEETS else (None, shot.image)
    given = camera and {name: np.asarray(value).tolist() for name, value in vars(camera).items()}
    there, here = ask(SEE, given, image), see(model, image, camera)
    assert (there["box"] is None) == (here.box is None)
    if here.box is not None:
        assert iou(there["box"], here.box).item() >= 0.9
        assert there["summary"].split(",")[0] == here.summary.split(",")[0]
    if len(here.probability):
        assert there["probability"][0] == pytest.approx(here.probability[0], abs=0.05)
    candidates = {tuple(box) for box in there["stages"]["candidates"]}
    assert candidates == {tuple(box) for box in here.detections.candidates}
    assert list(there["stages"]) == ["candidates", "kept", "names", "sight"]


@pytest.mark.browser
@pytest.mark.parametrize("shape", [(40, 60, 3), (1, 1, 3)])
def test_nothing_is_seen_where_there_is_nothing(ask, model, shape):
    image = np.full(shape, 128, np.uint8)
    assert ask(SEE, image=image)["summary"] == see(model, image).summary
