"""Files are written whole or not at all."""

import os

import pytest

from trunnion.report import atomic


def test_both_files_appear_and_nothing_else(tmp_path):
    atomic.write_files({tmp_path / "new" / "a.out": b"1", tmp_path / "new" / "a.json": b"2"})
    assert sorted(p.name for p in (tmp_path / "new").iterdir()) == ["a.json", "a.out"]
    assert (tmp_path / "new" / "a.json").read_bytes() == b"2"


@pytest.mark.parametrize("error", [KeyboardInterrupt, OSError("disk full")])
def test_an_interruption_leaves_the_old_files(tmp_path, monkeypatch, error):
    old = {tmp_path / "a.out": b"old", tmp_path / "a.json": b"old"}
    atomic.write_files(old)
    calls = []

    def fsync(number: int) -> None:
        calls.append(number)
        if len(calls) == 2:
            raise error

    monkeypatch.setattr(os, "fsync", fsync)
    with pytest.raises(type(error) if isinstance(error, Exception) else error):
        atomic.write_files(dict.fromkeys(old, b"new"))
    assert {p: p.read_bytes() for p in tmp_path.iterdir()} == old


def test_a_folder_in_the_way_is_named_and_nothing_is_written(tmp_path):
    (tmp_path / "a.json").mkdir()
    with pytest.raises(IsADirectoryError) as caught:
        atomic.write_files({tmp_path / "a.out": b"1", tmp_path / "a.json": b"2"})
    assert caught.value.filename == str(tmp_path / "a.json")
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


def test_errors_name_the_file_that_was_asked_for(tmp_path):
    target = tmp_path / ("a" * 300)
    with pytest.raises(OSError, match="too long") as caught:
        atomic.write_files({target: b"1"})
    assert caught.value.filename == str(target)
