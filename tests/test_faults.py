"""Faults, tried on purpose: each has a clear message, and no wrong number comes out of it."""

import json
import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

from reproduce import results
from reproduce.pipeline import checksums, steps
from tests.project import ROOT, code_cells, each_chapter, run
from vmc_lib import data, marker_sheet, photos
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.camera import Camera
from vmc_lib.cerebellum.forward_model import arm_copy
from vmc_lib.cerebellum.offline import calibrate
from vmc_lib.cerebellum.online import AimCorrection, WeightCorrection
from vmc_lib.motor.execution import execute
from vmc_lib.motor.inverse_dynamics import static_activation
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import load
from vmc_lib.show import check, questions
from vmc_lib.show.arm import arm_scene
from vmc_lib.what.crops import crop
from vmc_lib.what.recogniser import Recogniser
from vmc_lib.where.segmentation import segment

REMEDY = "git checkout -- .*python -m reproduce --list"


def test_shipped_files_have_their_checksums():
    checksums_now = checksums.data_checksums()
    assert checksums_now == json.loads(data.CHECKSUMS.read_bytes()), (
        "run python -m reproduce.pipeline.checksums"
    )
    assert {"templates.npz", "photos/rig/test/000.jpg"} <= checksums_now.keys()


@pytest.fixture
def shipped(tmp_path, monkeypatch):
    """A copy of a few files that ship, verified as those are."""
    sums = {}
    for name in ("templates.npz", "recogniser.npz", "photos/rig/test/000.json"):
        for file in {data.FOLDER / name, (data.FOLDER / name).with_suffix(".jpg")}:
            if file.exists():
                copy = tmp_path / file.relative_to(data.FOLDER)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, copy)
                sums[copy] = data.checksum(file.read_bytes())
    monkeypatch.setattr(data, "_checksums", lambda: sums)
    return tmp_path


def cut(path):
    path.write_bytes(path.read_bytes()[:-100])


def swap(path):
    shutil.copy(path.with_name("recogniser.npz"), path)


def test_whole_files_are_read(shipped):
    assert data.arrays("templates", shipped)
    assert len(photos.load("rig", "test", shipped / "photos")) == 1


@pytest.mark.parametrize("harm", [cut, swap])
def test_a_damaged_file_is_named_with_its_remedy(shipped, harm):
    harm(shipped / "templates.npz")
    with pytest.raises(ValueError, match=f"templates.npz is damaged: .*{REMEDY}"):
        data.arrays("templates", shipped)


@pytest.mark.parametrize("kind", ["jpg", "json"])
def test_a_damaged_photo_is_named(shipped, kind):
    cut(shipped / f"photos/rig/test/000.{kind}")
    with pytest.raises(ValueError, match=f"000.{kind} is damaged: .*{REMEDY}"):
        photos.load("rig", "test", shipped / "photos")


def test_a_missing_file_is_named(shipped):
    (shipped / "templates.npz").unlink()
    with pytest.raises(FileNotFoundError, match=f"templates.npz is missing. .*{REMEDY}"):
        data.arrays("templates", shipped)
    with pytest.raises(ValueError, match="no photos under"):
        photos.load("free", "test", shipped / "photos")


def test_arrays_that_are_shared_cannot_be_replaced():
    with pytest.raises(TypeError, match="does not support item assignment"):
        data.arrays("cdbn")["mean"] = np.zeros(1)


def test_damage_without_a_checksum_is_noticed(tmp_path):
    shutil.copy(results.FOLDER / "optimal.npz", tmp_path)
    cut(tmp_path / "optimal.npz")
    with pytest.raises(ValueError, match=f"optimal.npz is damaged: .*{REMEDY}"):
        results.arrays("optimal", folder=tmp_path)
    (tmp_path / "lesions.json").write_text('{"rows": [', encoding="utf-8")
    with pytest.raises(ValueError, match=f"lesions.json is damaged: .*{REMEDY}"):
        results.records("lesions", tmp_path)


def test_a_read_only_checkout_is_enough(tmp_path):
    copy = tmp_path / "checkout"
    keep = shutil.ignore_patterns("__pycache__", "photos", "localisers.npz", "detectors.npz")
    shutil.copytree(ROOT / "vmc_lib", copy / "vmc_lib", ignore=keep)
    for path in (copy, *copy.rglob("*")):
        path.chmod(path.stat().st_mode & ~0o222)
    see = "from vmc_lib.motor.planning import plan; from vmc_lib.motor import templates\n"
    see += "from vmc_lib.motor.execution import execute\n"
    see += "print(execute(plan((0.12, -0.42), templates.load())).motion.q.shape)"
    command = [sys.executable, "-c", see]
    if os.getuid() == 0:  # whom no permission stops: without root's power, then
        command = ["setpriv", "--bounding-set=-all", "--inh-caps=-all", *command]
        if not shutil.which("setpriv"):
            pytest.skip("NOT TESTED as root: setpriv is missing")
    try:
        run(*command, cwd=copy)
    finally:
        for path in (copy, *copy.rglob("*")):
            path.chmod(path.stat().st_mode | 0o200)


@pytest.mark.parametrize("name", ["a.npz", "a.json"])
def test_full_disk_leaves_the_old_file(tmp_path, name):
    file = tmp_path / name
    steps.write(file, lambda: {"rows": [1, 2]})
    before = file.read_bytes()
    noise = np.random.default_rng(0).random(9999).tolist()
    resource = pytest.importorskip("resource", reason="NOT TESTED: no limits on this system")
    least, most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, most))  # no file may become longer
    try:
        with pytest.raises(OSError, match=r"File too large|No space left"):
            steps.write(file, lambda: {"rows": noise})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (least, most))
    assert file.read_bytes() == before
    assert list(tmp_path.iterdir()) == [file]


def test_an_interrupted_installation_resumes(tmp_path):
    for name in ("Makefile", "requirements.txt", "constraints.txt", "pyproject.toml"):
        shutil.copy(ROOT / name, tmp_path)
    python = tmp_path / "python"  # it makes an environment whose pip only ends as it is told
    pip = "#!/bin/sh\\nexit $PIP_ENDS\\n"
    python.write_text(
        f"#!/bin/sh\n[ $1 = -c ] || {{ mkdir -p .venv/bin; printf '{pip}' >.venv/bin/pip; "
        "chmod +x .venv/bin/pip; }\n",
        encoding="utf-8",
    )
    python.chmod(0o755)
    for ends in (130, 0):  # Ctrl-C, then once more
        environment = os.environ | {"PIP_ENDS": str(ends)}
        command = ["make", ".venv/.ready", f"PYTHON={python}"]
        done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True)
        assert (done.returncode == 0) == (ends == 0)
        assert (tmp_path / ".venv/.ready").exists() == (ends == 0)


CAMERA = Camera(600.0, np.array([300.0, 200.0]), np.eye(3), np.zeros(3))
GREY = np.full((20, 30, 3), 0.5, np.float32)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: segment(GREY, k=0), "k = .*0.*above 0"),
        (lambda: segment(GREY * np.nan), "finite"),
        (lambda: segment(GREY[..., 0]), r"\(height, width, c\)"),
        (lambda: segment(np.uint8(255 * GREY)), "uint8 are not in 0..1: see photos.as_float"),
        (lambda: crop(255 * GREY, (0, 0, 9, 9)), "divide 8 bits by 255"),
        (lambda: hand((0.1, 0.2, 0.3)), r"posture \(0.1, 0.2, 0.3\): .*each joint.* in rad"),
        (lambda: arm_copy(np.nan), "nan times as strong"),
        (lambda: WeightCorrection().update(plan((0.15, -0.4), load())), "plan for targets"),
        (lambda: AimCorrection(load()).update(plan((0.15, -0.4), load())), "plan for targets"),
        (lambda: marker_sheet.estimate_camera(GREY * 255), "divide 8 bits by 255"),
        (lambda: inverse_kinematics((0.1, 0.2, 0.3)), r"\(…, 2\), in m"),
        (
            lambda: execute(plan((0.15, -0.4), load()), prism=30.0),
            "prism of 30.0 rad: give radians",
        ),
        (lambda: execute(plan((0.15, -0.4), load()), prism=np.nan), "prism of nan"),
        (lambda: static_activation((30, 60)), r"posture \[30. 60.\] rad is beyond .* np.radians"),
        (lambda: static_activation((np.nan, 1)), r"posture \[nan  1.\] rad is beyond"),
        (lambda: execute([0.15, -0.4]), r"\[0.15, -0.4\] is no Plan: give what plan"),
        (lambda: plan((0.15, -0.4), load(), rule="Eq. 4"), "'Eq. 4': choose from .*'exact'"),
        (lambda: calibrate(plan((0.15, -0.4), load()), "best"), "'best': choose from .* 'own'"),
        (lambda: CAMERA.back_project([[1, 2, 3]]), r"pixels of shape \(1, 3\): give \(n, 2\)"),
        (lambda: CAMERA.project([1, 2]), r"points of shape \(2,\): give \(n, 3\)"),
        (lambda: Recogniser.load().probability(np.zeros((2, 100, 100))), r"give .*\(n, 200, 200\)"),
        (lambda: arm_scene((0, 130)), r"posture \[  0. 130.\] rad is beyond .* np.radians"),
        (lambda: arm_scene((0, 1, 2)), r"posture \(0, 1, 2\) .* give 2 numbers"),
        (lambda: arm_scene((0, 1), 5 * [0]), r"activation .* \(5,\): give 6 numbers"),
        (lambda: arm_scene((0, 1), balls=[((0, 1), "red")]), "ball's position .* give 3 numbers"),
        (lambda: arm_scene((0, 1), balls=[((0, 1, 0), "teal")]), "called 'teal': choose from blue"),
        (lambda: load(hold=-1), "hold of -1 s: give seconds"),
        (lambda: load(hold=np.nan), "hold of nan"),
    ],
)
def test_wrong_input_is_named_with_its_remedy(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_a_float_photo_of_the_sheet_is_taken():
    assert marker_sheet.estimate_camera(GREY) is None


@each_chapter
def test_demo_without_its_cells_raises_name_error(path):
    demos = [cell.source for cell in code_cells(path) if "explore(" in cell.source]
    with pytest.raises(NameError):
        exec(demos[-1], {})  # noqa: S102


@pytest.mark.parametrize(
    ("answer", "verdict"),
    [
        ("abc", "Not read. Write a number"),
        ([11.5, [1, 2]], "✗ Not yet. You have [11.5, [1, 2]]."),
        ([None, [1, 2]], "Not answered yet."),
        ([[None, 1], [3]], "Not answered yet."),
        ([np.zeros(2), np.zeros((2, 3))], "✗ Not yet."),
    ],
)
def test_any_answer_gets_a_verdict(answer, verdict, outputs, monkeypatch):
    """More, right and wrong, in tests/show/test_questions.py."""
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    page = outputs(questions)
    check(answer, 11.5)
    words = re.sub(r"<style>.*?</style>|<[^>]*>", "", page[0], flags=re.S).replace("&#x27;", "'")
    assert words.startswith(verdict)
