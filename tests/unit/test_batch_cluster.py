"""trunnion batch --scheduler: a Dask cluster of two workers, one of them killed midway."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

import trunnion
from trunnion.many.records import FOLDER

MODELS = Path(__file__).parents[2] / "models"
LOCAL = ("--host", "127.0.0.1", "--no-dashboard")


@contextmanager
def started(*arguments, log):
    """A process of Dask's that ends with the test."""
    with log.open("w") as out:
        process = subprocess.Popen(
            [sys.executable, "-m", *map(str, arguments)],
            stdout=out, stderr=out, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        )  # fmt: skip
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@contextmanager
def cluster(folder, n):
    """Address and worker processes of a scheduler on this machine's loopback."""
    from contextlib import ExitStack

    file = folder / "scheduler.json"
    with ExitStack() as stack:
        enter = stack.enter_context
        kind = "distributed.cli.dask_scheduler"
        scheduler = enter(
            started(kind, *LOCAL, "--port", 0, "--scheduler-file", file, log=folder / "s.log")
        )
        until = time.monotonic() + 60
        while not file.exists():
            assert scheduler.poll() is None, (folder / "s.log").read_text()
            assert time.monotonic() < until
            time.sleep(0.05)
        kind = "distributed.cli.dask_worker"
        own = ("--scheduler-file", file, "--nthreads", 1, "--no-nanny")
        workers = [enter(started(kind, *LOCAL, *own, log=folder / f"w{i}.log")) for i in range(n)]
        for i in range(n):
            while "Registered to" not in (folder / f"w{i}.log").read_text():
                assert time.monotonic() < until, (folder / f"w{i}.log").read_text()
                time.sleep(0.05)
        yield json.loads(file.read_text())["address"], workers


def reports(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir() if p.suffix in (".out", ".json")}


def test_nothing_is_lost_when_one_of_two_workers_is_killed_midway(tmp_path):
    folder = tmp_path / "decks"
    folder.mkdir()
    decks = [
        shutil.copy(MODELS / "rack_50.inp", folder / f"r{i:02d}.inp") for i in range(60)
    ]  # enough that a busy machine sees it midway
    bad = folder / "bad.inp"
    bad.write_text("PIPE 10 20 DX=1\nSUPORT 20 +Y\n")
    out = tmp_path / "out"
    with cluster(tmp_path, 2) as (address, workers):
        arguments = ["batch", *decks, bad, "-o", out, "--scheduler", address]
        batch = subprocess.Popen(
            [sys.executable, "-m", "trunnion", *map(str, arguments)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        while len(list((out / FOLDER).glob("*.json"))) < 2:
            assert batch.poll() is None, batch.communicate()
            time.sleep(0.005)
        os.kill(workers[0].pid, signal.SIGKILL)
        text, _ = batch.communicate(timeout=120)
        assert batch.returncode == 2, text
        assert "60 certified, 1 bad deck" in text
        written = (out / "r00.json").stat().st_mtime_ns
        again = trunnion.batch(decks, out, scheduler=address)
        assert all(entry.skipped for entry in again.entries)
        assert (out / "r00.json").stat().st_mtime_ns == written
    trunnion.batch(decks, tmp_path / "here")
    assert reports(out) == reports(tmp_path / "here")


def test_a_scheduler_that_does_not_answer_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("trunnion.many.cluster.ANSWERS", "0.5s")
    with pytest.raises(trunnion.BatchError, match=r"127\.0\.0\.1:9"):
        trunnion.batch([MODELS / "pipe_10m.inp"], tmp_path, scheduler="tcp://127.0.0.1:9")


def test_without_the_extra_the_message_names_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(trunnion.BatchError, match=r"trunnion\[dask\]"):
        trunnion.batch([MODELS / "pipe_10m.inp"], tmp_path, scheduler="tcp://127.0.0.1:9")
