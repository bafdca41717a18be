"""The pipeline that remakes every file: each step at toy size, and its dependencies."""

import re

import numpy as np
import pytest

from reproduce import __main__, results
from reproduce.experiments.localisation import TABLE_1_KERNELS
from reproduce.ledger.entry import VERDICTS
from reproduce.pipeline import progress, smoke_run, stored
from reproduce.pipeline.steps import RESULTS, ROOT, STEPS, Step, tasks
from vmc_lib import data, photos
from vmc_lib.what.recogniser import READ_OUTS

BY_NAME = {step.name: step for step in STEPS}


@pytest.fixture(scope="module")
def toy(tmp_path_factory):
    """The folder in which every step has made its file at toy size."""
    folder = tmp_path_factory.mktemp("toy")
    assert smoke_run.run_all(folder) == 0
    return folder


def keys(folder, name):
    return set(data.arrays(name, folder))


@pytest.mark.audit
def test_every_step_has_a_toy(toy):
    functions = {name for name, step in BY_NAME.items() if not isinstance(step.make, str)}
    assert {file.stem for file in toy.glob("*.*") if file.name[0] != "."} == functions | {"photos"}


@pytest.mark.audit
@pytest.mark.parametrize(
    "name",
    ["detectors", "localisers", "cdbn", "recogniser", "recognition", "photographs", "tricks"],
)
def test_toy_file_has_the_arrays_of_the_shipped_one(toy, name):
    """Array by array, of the same kind and with as many axes; but one round of box regression."""
    shipped, small = data.arrays(name, BY_NAME[name].file.parent), data.arrays(name, toy)
    assert {key for key in shipped if not re.search(r"regression [1-3]", key)} == set(small)
    for key, value in small.items():
        kinds = {value.dtype.kind, shipped[key].dtype.kind}
        assert value.ndim == shipped[key].ndim, key
        assert len(kinds) == 1, key


@pytest.mark.audit
@pytest.mark.parametrize("name", ["candidates", "localisation"])
def test_toy_file_has_some_arrays_of_the_shipped_one(toy, name):
    assert keys(toy, name) < keys(BY_NAME[name].file.parent, name)


@pytest.mark.audit
def test_toy_candidates_equal_the_shipped_ones(toy):
    shipped = data.arrays("candidates")
    for name, boxes in data.arrays("candidates", toy).items():
        np.testing.assert_allclose(boxes, shipped[name], atol=1, err_msg=name)


@pytest.mark.audit
def test_toy_experiments_give_shares_and_counts(toy):
    table = data.arrays("localisation", toy)["rig/context/table 1/0"]
    assert table.shape == (len(photos.SPLITS), len(TABLE_1_KERNELS), 2)
    assert table.min() >= 0
    assert table.max() <= 1
    counts = data.arrays("variations", toy)["(6, 0)/counts"]
    boxes = [2 * len(smoke_run.NAMED[split]) for split in ("validation", "test")]
    assert (counts.sum(3) == boxes).all()
    assert counts.shape[1] == len(READ_OUTS)
    scenarios = results.records("movements", toy)
    assert all(np.isfinite(x).all() for part in scenarios.values() for x in part.values())
    questions = {str(question) for question, _ in results.records("fresh_test_set", toy)}
    assert {"linear", "improved", "['MP2', 0]", "['linear', 0]", "['IoU', 0]"} < questions
    (row,) = results.records("ledger", toy)["rows"]
    assert row["verdict"] in VERDICTS


def test_steps_have_no_circular_inputs():
    """Every input is there, and doit finds an order: a step's inputs are made before it."""
    order = list(BY_NAME)
    for step in STEPS:
        if not isinstance(step.make, str):
            assert step.inputs()
            assert all(file.is_file() for file in step.inputs())
        for name in step.reads.split():
            if name in BY_NAME:
                assert order.index(name) < order.index(step.name)
            else:
                assert (ROOT / name).exists(), name


def test_the_ledger_reads_all_that_its_rows_rest_on():
    read = {file.relative_to(RESULTS).with_suffix("").as_posix() for file in ledger_results()}
    assert stored.RESTS_ON.keys() <= read


def ledger_results():
    """The stored results on which the ledger's step depends."""
    return [file for file in BY_NAME["ledger"].inputs() if file.is_relative_to(RESULTS)]


def test_a_step_depends_on_all_code_that_it_can_run():
    for name, code in {
        "ledger": "reproduce/paper.py vmc_lib/statistics.py reproduce/peers/optimal_control.py",
        "detectors": "vmc_lib/boxes.py vmc_lib/compiled.py reproduce/training/shipped_models.py",
        "ablation": "reproduce/training/ventral_stream.py",  # imported in a function
    }.items():
        assert {ROOT / file for file in code.split()} <= BY_NAME[name].inputs()


def test_every_file_that_ships_has_its_step():
    shipped = {*data.FOLDER.glob("*.npz"), *results.FOLDER.glob("*.npz")}
    shipped |= set(results.FOLDER.glob("*.json"))
    assert shipped <= {step.file for step in STEPS}


def squares(n=3):
    """What a step makes that only these tests know."""
    return {"squares": np.arange(n) ** 2}


@pytest.mark.audit
def test_a_step_runs_until_it_is_up_to_date(tmp_path, monkeypatch, capsys):
    step = Step(squares, tmp_path / "squares.npz", "README.md")
    monkeypatch.setattr("reproduce.pipeline.steps.STEPS", (step,))
    assert progress.run_tasks(tasks(), ["squares"], tmp_path) == 0
    assert data.arrays("squares", tmp_path)["squares"].tolist() == [0, 1, 4]
    assert progress.run_tasks(tasks(), ["squares"], tmp_path) == 0
    first, second = capsys.readouterr().out.splitlines()
    assert first.startswith("squares … ")
    assert first.endswith(" s")
    assert second == "squares: up to date"
    for harm in (b"", b'{"squ', b"null", b"\xff"):  # a disk was full, a synchronised folder's own
        (tmp_path / ".doit.json").write_bytes(harm)
        assert progress.run_tasks(tasks(), ["squares"], tmp_path) == 0
        assert "is damaged, and made anew" in capsys.readouterr().out


def test_a_folder_that_cannot_be_written_is_named(tmp_path, capsys):
    assert progress.run_tasks([], [], tmp_path / "nowhere") == 1
    assert f"{tmp_path / 'nowhere'} cannot be written" in capsys.readouterr().out


def test_the_list_names_every_step_its_file_and_its_minutes(capsys):
    assert __main__.main(["--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(BY_NAME)
    assert all(" min" in line for line in lines)
    assert "LLVM" in lines[0]


def test_default_run_skips_steps_with_special_needs(monkeypatch):
    ran = []
    monkeypatch.setattr(
        __main__, "run_tasks", lambda tasks, names, *rest: ran.append((names, rest)) or 0
    )
    assert __main__.main([]) == 0
    assert __main__.main(["--only", "opensim"]) == 0
    (usual, _), (only, (_, *options)) = ran
    assert usual == [name for name, step in BY_NAME.items() if not step.needs]
    assert only == ["opensim"]
    assert options == ["--single", "--always-execute"]


def test_smoke_uses_a_folder_of_its_own(monkeypatch):
    folders = []
    monkeypatch.setattr(smoke_run, "run_all", lambda folder: folders.append(folder) or 0)
    assert __main__.main(["--smoke"]) == 0
    assert folders[0] not in (ROOT, data.FOLDER, results.FOLDER)
    assert not folders[0].exists()


def test_an_unknown_step_is_refused(capsys):
    with pytest.raises(SystemExit):
        __main__.main(["--only", "everything"])
    assert "candidates" in capsys.readouterr().err


def test_a_step_that_reads_what_is_not_there_is_refused():
    one = Step(np.zeros, ROOT / "none.npz", "photos lost vmc_lib/no_such")
    with pytest.raises(ValueError, match=r"none reads \['lost', 'vmc_lib/no_such'\]"):
        one.inputs()
