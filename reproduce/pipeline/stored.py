"""What the ledger's rows rest on that ships ready-made, and how long it takes to make it again."""

from reproduce.ledger import anchor
from reproduce.pipeline.steps import STEPS
from vmc_lib.show import table

TABLES_1_AND_2 = "Table I", "Table II", "Ours, Table I", "Ours, Table II"
RESTS_ON = {  # a step, or what was recorded elsewhere -> the rows that read it
    "localisation": TABLES_1_AND_2,
    "fresh_test_set": (*TABLES_1_AND_2, "IV A, kernels", "Table III"),
    "region_clusters": ("Table I", "Ours, Table I"),
    "class_independence": ("IV A, search", "IV A, classes"),
    "recognition": ("Table III", "IV B, features"),
    "fresh_names": ("Table III", "IV B, features"),
    "hmax_draws": ("Table III",),
    "random_filters": ("Table III", "Fig. 1", "Ours, Fig. 1"),
    "variations": ("Table III", "III, width", "Fig. 7", "IV B, V1"),
    "other_filters": ("Fig. 7", "Fig. 8", "IV B, V1", "IV B, W²"),
    "second_layers": ("IV B, W²",),
    "optimal": ("III, Block 2, effort",),
    "movements": (
        "Table IV",
        "Table V",
        "Table VI",
        "Fig. 12",
        "IV D, online",
        "Ours, Table V",
        "Ours, Table VI",
    ),
    "nulls": (
        "Table IV",
        "Fig. 9",
        "IV C, templates",
        "Table V",
        "Fig. 4",
        "Fig. 10",
        "Ours, Table V",
        "Ours, Eq. 6–7",
        "Table VI",
        "Fig. 11",
        "Fig. 12",
        "IV D, online",
        "Ours, Eq. 5",
    ),
    "sensitivity": ("Table IV", "Table V", "Table VI"),
    "unsteady": ("Ours, Table V", "Ours, Table VI"),
    "learning_curves": ("Ours, Table V",),
    "opensim": ("III, Block 4",),
    "bench/loop": ("II A, speed",),
    "bench/planning": ("IV C, computation",),
}
NOT_AGAIN = {  # of which no test makes a draw again, and why
    "fresh_test_set": "no: its photos do not ship",
    "fresh_names": "no: its photos do not ship",
    "opensim": "no: it needs OpenSim",
    "bench/loop": "no: a clock",
    "bench/planning": "no: a clock",
}


def stored_table():
    """What is stored, as Markdown: its rows, minutes to make it again, and whether a test does."""
    lines = [
        [
            f"`{name}`",
            ", ".join(f'<a href="#{anchor(where)}">{where}</a>' for where in rows),
            _minutes(name),
            NOT_AGAIN.get(name, "yes"),
        ]
        for name, rows in RESTS_ON.items()
    ]
    return table(["stored", "rows", "minutes", "one draw made again"], lines)


def _minutes(name):
    """The minutes of the step of that name, and what it needs; none where it is no step."""
    steps = {step.name: step for step in STEPS}
    if name not in steps:
        return ""
    minutes, needs = f"{steps[name].minutes:g}", steps[name].needs  # a step, or words
    if needs in steps:
        needs = f"{needs} ({steps[needs].minutes:g})"
    return f"{minutes}, and {needs}" if needs else minutes
