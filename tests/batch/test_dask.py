"""Batches by Dask: the same bytes, also when a worker is killed; a clear error without it."""

import os
import sys

import pytest
from missing_here import KILL

import engine3d as e3d
from engine3d.batch import read_manifest, run


@pytest.fixture
def cluster():
    distributed = pytest.importorskip("distributed", reason="pip install 'engine3d[dask]'")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as cluster:
        yield cluster


@pytest.fixture
def tasks(manifest):
    return read_manifest(
        manifest({"script": "script.py", "matrix": {"seed": {"count": 40}}, "size": [200, 150]})
    ).tasks


@pytest.mark.slow
def test_dask_draws_the_same_even_if_a_worker_is_killed(cluster, tasks, tmp_path):
    serial = run(tasks, tmp_path / "serial", jobs=1)
    whole = run(tasks, tmp_path / "whole", scheduler=cluster.scheduler_address)
    assert whole.hash == serial.hash and whole.drawn == 40

    from distributed import Client

    with Client(cluster, set_as_default=False) as client:
        processes = list(client.run(os.getpid).values())
        assert len(processes) == 2
        seen = []

        def kill_one(task, outcome, text):
            seen.append(task)
            if len(seen) == 8:
                os.kill(processes[0], KILL)

        killed = run(tasks, tmp_path / "killed", executor=client, progress=kill_one)
    assert killed.hash == serial.hash and killed.failures == []
    assert killed.drawn + killed.done_before == 40


def test_without_dask_the_error_names_the_extra(tasks, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(e3d.InvalidArgumentError, match=r"pip install 'engine3d\[dask\]'"):
        run(tasks, tmp_path / "out", scheduler="tcp://127.0.0.1:1")


def test_a_scheduler_that_is_not_there_is_an_error(tasks, tmp_path, monkeypatch):
    pytest.importorskip("distributed", reason="pip install 'engine3d[dask]'")
    monkeypatch.setattr("engine3d.apps.batch.dask_engine._PATIENCE", 0.3)
    with pytest.raises(e3d.InvalidArgumentError, match="no Dask scheduler with workers answers at"):
        run(tasks, tmp_path / "out", scheduler="tcp://127.0.0.1:1")
