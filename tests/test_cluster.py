"""What joblib spreads over cores, a Dask cluster takes as well, and the numbers do not change."""

import numpy as np
import pytest
from dask.distributed import Client, LocalCluster
from joblib import parallel_config

from reproduce.experiments.loop_evaluation import evaluate
from vmc_lib import photos


@pytest.mark.audit
def test_a_dask_cluster_takes_the_trial(monkeypatch):
    few = {split: photos.load("rig", split)[:n] for split, n in (("train", 10), ("test", 2))}
    monkeypatch.setattr(photos, "load", lambda level, split, folder: few[split])
    alone = evaluate("rig")
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
        parallel_config("dask"),
    ):
        assert client.scheduler.address.startswith("tcp://127.0.0.1")  # nobody else may listen in
        together = evaluate("rig")
    for key, values in alone.items():
        np.testing.assert_array_equal(values, together[key])
