"""The files that were opened lately."""

import os

import pytest

from engine3d.apps.desktop.recent_files import MOST, RecentFiles


def test_recent_files_are_kept_the_latest_first(tmp_path):
    for name in "abc":
        (tmp_path / name).write_bytes(b"")
    store = tmp_path / "state" / "recent.json"
    recent = RecentFiles(store)
    assert recent.paths() == ()
    for name in ("a", "b", "c", "a"):
        recent.add(tmp_path / name)
    assert [os.path.basename(path) for path in RecentFiles(store).paths()] == ["a", "c", "b"]
    (tmp_path / "c").unlink()
    assert [os.path.basename(path) for path in recent.paths()] == ["a", "b"]
    for k in range(30):
        (tmp_path / f"f{k}").write_bytes(b"")
        recent.add(tmp_path / f"f{k}")
    assert len(recent.paths()) == MOST
    recent.clear()
    assert recent.paths() == ()


@pytest.mark.filterwarnings("ignore:.*begins anew")
def test_a_damaged_list_is_an_empty_one(tmp_path):
    store = tmp_path / "recent.json"
    for text in ("", "{", "3", "[" * 100_000, '[1, null, "/none"]', "\xff"):
        store.write_text(text, encoding="latin-1")
        assert RecentFiles(store).paths() == ()
    (tmp_path / "file").write_bytes(b"")
    RecentFiles(tmp_path / "file" / "recent.json").add("a")  # no error


def test_lists_of_earlier_versions_are_found(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    paths = [str(tmp_path / name) for name in ("a", "b", "c\xff" if os.name == "nt" else "c\udcff")]
    for path in paths:
        open(path, "wb").close()
    lines = tmp_path / "state" / "engine3d" / "recent-files"
    lines.parent.mkdir(parents=True)
    lines.write_bytes(b"".join(os.fsencode(path) + b"\n" for path in paths[1:]) + b"\0\n\xff\n")
    assert RecentFiles().paths() == tuple(paths[1:])
    RecentFiles().add(paths[0], paths[1])
    assert RecentFiles().paths() == tuple(paths)
    RecentFiles().clear()
    assert RecentFiles().paths() == ()


def test_what_is_no_file_is_not_remembered(tmp_path):
    recent = RecentFiles(tmp_path / "recent.json")
    recent.add(tmp_path / "none", tmp_path)
    assert os.listdir(tmp_path) == []
