"""Forked processes: a death costs one task once, is named, and leaves no process behind."""

import os
import signal
import time

import pytest

from trunnion.many.forked import run_forked


def alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_every_task_is_answered():
    ends = list(run_forked(range(7), lambda n: n * n, 2))
    assert sorted((end.index, end.result) for end in ends) == [(n, n * n) for n in range(7)]


def test_a_task_whose_worker_dies_once_is_answered_and_the_death_named(tmp_path):
    def work(n):
        mark = tmp_path / f"tried{n}"
        if n == 1 and not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return n

    ends = {end.index: end for end in run_forked(range(3), work, 2)}
    assert [ends[n].result for n in range(3)] == [0, 1, 2]
    assert [len(ends[n].deaths) for n in range(3)] == [0, 1, 0]
    assert "killed by SIGKILL" in ends[1].deaths[0]


def test_a_task_that_kills_every_worker_is_given_up_after_two():
    def work(n):
        if n == 0:
            os._exit(7)
        return n

    ends = {end.index: end for end in run_forked(range(2), work, 1)}
    assert ends[1].result == 1
    assert ends[0].result is None
    assert len(ends[0].deaths) == 2
    assert all("ended without an answer (exit 7)" in death for death in ends[0].deaths)


def test_no_more_processes_than_asked_for(tmp_path):
    def work(n):
        (tmp_path / f"run{n}").touch()
        time.sleep(0.05)
        count = len(list(tmp_path.glob("run*")))
        (tmp_path / f"run{n}").unlink()
        return count

    assert max(end.result for end in run_forked(range(8), work, 3)) <= 3


def test_leaving_early_ends_the_children(tmp_path):
    def work(n):
        (tmp_path / f"pid{n}").write_text(str(os.getpid()))
        if n:
            time.sleep(60)

    ends = run_forked(range(3), work, 3)
    assert next(ends).index == 0
    while len(list(tmp_path.glob("pid*"))) < 3:
        time.sleep(0.01)
    ends.close()
    pids = [int(path.read_text() or 0) for path in tmp_path.glob("pid*")]
    assert not any(map(alive, filter(None, pids)))


def test_what_died_is_swept_up_behind():
    swept = []

    def work(n):
        os._exit(1)

    end = next(run_forked([0], work, 1, swept=swept.append))
    assert [str(pid) in death for pid, death in zip(swept, end.deaths, strict=True)] == [True, True]


@pytest.mark.parametrize("size", [10, 5_000_000])
def test_large_answers_come_whole(size):
    end = next(run_forked([size], lambda n: b"x" * n, 1))
    assert len(end.result) == size
