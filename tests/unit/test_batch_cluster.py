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
    """A scheduler on this machine's loopback: its address, its workers' processes, its own."""
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
        yield json.loads(file.read_text())["address"], workers, scheduler


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
    with cluster(tmp_path, 2) as (address, workers, _):
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


def killing(process, told):
    """A listener that kills a process at the first deck that comes."""

    def first(entry):
        if not told:
            process.kill()
        told.append(entry)

    return first


def test_decks_without_any_worker_left_are_listed_and_solved_by_the_next(tmp_path, monkeypatch):
    """Dask would wait for ever for an answer that died with the last worker."""
    monkeypatch.setattr("trunnion.many.cluster.PATIENCE", 2.0)
    decks = [shutil.copy(MODELS / "rack_50.inp", tmp_path / f"r{i:02d}.inp") for i in range(20)]
    out, told, warnings = tmp_path / "out", [], []
    with cluster(tmp_path, 1) as (address, workers, _):
        done = trunnion.batch(
            decks, out, scheduler=address, told=killing(workers[0], told), warned=warnings.append
        )
        solved = [entry for entry in done.entries if entry.status == "certified"]
        left = [entry for entry in done.entries if entry.status == "internal error"]
        assert solved
        assert left
        assert len(solved) + len(left) == len(decks)
        assert {entry.causes for entry in left} == {("on the cluster: no worker for 2 s",)}
        assert done.code == 3
        assert (out / "batch-summary.json").exists()
        assert len(warnings) == 1
        assert f"no worker at {address}" in warnings[0]
        own = ("--scheduler-file", tmp_path / "scheduler.json", "--nthreads", 1, "--no-nanny")
        kind = "distributed.cli.dask_worker"
        with started(kind, *LOCAL, *own, log=tmp_path / "next.log"):
            monkeypatch.setattr("trunnion.many.cluster.PATIENCE", 60.0)
            again = trunnion.batch(decks, out, scheduler=address)
    assert again.code == 0
    assert [entry.skipped for entry in again.entries].count(True) == len(solved)


def test_decks_that_a_scheduler_took_with_it_are_listed(tmp_path):
    decks = [shutil.copy(MODELS / "rack_50.inp", tmp_path / f"r{i:02d}.inp") for i in range(20)]
    with cluster(tmp_path, 1) as (address, _, scheduler):
        done = trunnion.batch(
            decks, tmp_path / "out", scheduler=address, told=killing(scheduler, [])
        )
    left = [entry for entry in done.entries if entry.status == "internal error"]
    assert left
    assert done.code == 3
    assert all("scheduler went away" in entry.causes[0] for entry in left)


def test_a_scheduler_that_does_not_answer_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("trunnion.many.cluster.ANSWERS", "0.5s")
    with pytest.raises(trunnion.BatchError, match=r"127\.0\.0\.1:9"):
        trunnion.batch([MODELS / "pipe_10m.inp"], tmp_path, scheduler="tcp://127.0.0.1:9")


def test_without_the_extra_the_message_names_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(trunnion.BatchError, match=r"trunnion\[dask\]"):
        trunnion.batch([MODELS / "pipe_10m.inp"], tmp_path, scheduler="tcp://127.0.0.1:9")
