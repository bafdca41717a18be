"""How many seconds of movement each simulator of the arm computes in a second, in one run.

    ARM26=path/to/arm26.osim .bench/bin/python -m tools.bench.simulators

All compute the same second: a reach that the book remembers. OpenSim steps its own arm26 (elastic
tendons) at several accuracies; MuJoCo steps our arm, once with its own muscles and once with the
paper's. Each has one thread and is charged the processor's seconds: what else the machine does
meanwhile does not count. The error is how far the joints end from where the same simulator puts
them in much finer steps; "as exact" is the fastest OpenSim whose error is no greater than ours.
"""

import os
from functools import partial
from time import process_time

import mujoco
import numpy as np
from mujoco import rollout

from tools.bench.opensim_reference import excited_model, run, state_in_posture
from tools.bench.report import publish, seconds
from vmc_lib.arm.model import F0, L0, MUSCLES, SLACK, STEP, XML
from vmc_lib.arm.simulate import simulate
from vmc_lib.motor.templates import START, load

REACH = load().excitations[0]  # (1000, 6)
BATCHES = (1, 20, 500)
FINE = 20  # small steps in one of ours


def opensim_run(accuracy):
    """Ends of the reach (1, 2) in OpenSim's own arm, as a function to be timed."""
    model = excited_model(REACH, elastic=True)
    state, joints = state_in_posture(model, START)
    model.equilibrateMuscles(state)
    return lambda: run(model, state, joints, [1.0], accuracy)


def native_run(batch, finer=1):
    """Ends (batch, 2) in our arm with MuJoCo's own muscles, by its rollout, to be timed."""
    spec = mujoco.MjSpec.from_string(XML)
    for name, force, fibre, slack in zip(MUSCLES, F0, L0, SLACK, strict=True):
        actuator = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_TENDON)
        actuator.set_to_muscle(timeconst=[0.01, 0.04], tausmooth=0, range=[0, 1], force=force)
        actuator.lengthrange = [slack, slack + fibre]
    spec.compiler.LRopt.mode = mujoco.mjtLRMode.mjLRMODE_NONE
    spec.option.timestep = STEP / finer
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos, data.act = START, REACH[0]
    state = np.empty(mujoco.mj_stateSize(model, full := mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, full)
    states, excitations = np.tile(state, (batch, 1)), np.tile(REACH.repeat(finer, 0), (batch, 1, 1))
    return lambda: rollout.rollout(model, data, states, excitations)[0][:, -1, 1:3]


def our_run(engine, batch, finer=1):
    """Ends (batch, 2) in our arm with the paper's muscles, to be timed."""
    excitations = np.tile(REACH.repeat(finer, 0), (batch, 1, 1))
    return lambda: simulate(excitations, START, engine=engine, step=STEP / finer).q[:, -1]


def main():
    finest = opensim_run(1e-9)()
    accuracies = (1e-3, 1e-4, 1e-5, 1e-6)
    runs = [(f"OpenSim, accuracy {a:.0e}", 1, opensim_run(a), finest) for a in accuracies]
    for name, make in {
        "MuJoCo, its own muscle": native_run,
        "ours, MuJoCo": partial(our_run, "mujoco"),
        "ours, compiled": partial(our_run, "compiled"),
    }.items():
        finest = make(1, FINE)()
        runs += [(name, batch, make(batch), finest) for batch in BATCHES]
    rates = [batch / seconds(call, clock=process_time) for _, batch, call, _ in runs]
    errors = [np.abs(call() - finest).max() for _, _, call, finest in runs]
    peers = zip(rates[: len(accuracies)], errors, strict=False)
    peer = max(rate for rate, error in peers if error <= errors[-1])  # as exact as ours
    columns = "simulator", "batch", "simulated s per s", "× OpenSim as exact", "error (rad)"
    table = [
        (name, batch, round(rate, 1), round(rate / peer, 1), float(f"{error:.1e}"))
        for (name, batch, *_), rate, error in zip(runs, rates, errors, strict=True)
    ]
    publish("simulators", [dict(zip(columns, row, strict=True)) for row in table])


if __name__ == "__main__":
    if "ARM26" in os.environ:
        main()
    else:
        print("Left out: say where OpenSim's arm26.osim is, make bench ARM26=path/to/arm26.osim")
