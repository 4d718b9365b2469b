"""Where programs keep what outlives them, on each system."""

from pathlib import Path

import pytest

from engine3d.apps.desktop.user_folders import user_path

VARIABLES = ("XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME", "APPDATA", "LOCALAPPDATA")
KINDS = ("config", "state", "cache")


@pytest.fixture
def home(tmp_path, monkeypatch):
    for variable in VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    for variable in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(variable, str(tmp_path))
    return tmp_path


def folders():
    return [user_path(kind, "a").parent for kind in KINDS]


def test_the_specification_of_xdg_counts_elsewhere(home, monkeypatch):
    monkeypatch.setattr("sys.platform", "linux")
    usual = [home / ".config", home / ".local" / "state", home / ".cache"]
    assert folders() == [place / "engine3d" for place in usual]
    for variable in VARIABLES[:3]:
        monkeypatch.setenv(variable, str(home / variable))
    assert folders() == [home / variable / "engine3d" for variable in VARIABLES[:3]]
    for variable in VARIABLES[:3]:
        monkeypatch.setenv(variable, "relative")
    assert folders() == [place / "engine3d" for place in usual]


def test_windows_and_macos_have_folders_of_their_own(home, monkeypatch):
    monkeypatch.setattr("sys.platform", "darwin")
    library = home / "Library"
    names = ("Application Support", "Application Support", "Caches")
    assert folders() == [library / name / "engine3d" for name in names]
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setenv("APPDATA", str(home / "roaming"))
    monkeypatch.setenv("LOCALAPPDATA", str(home / "local"))
    assert folders() == [home / name / "engine3d" for name in ("roaming", "local", "local")]


def test_what_an_earlier_version_kept_elsewhere_is_found(home, monkeypatch):
    monkeypatch.setattr("sys.platform", "darwin")
    earlier = home / ".cache" / "engine3d" / "unsaved"
    earlier.mkdir(parents=True)
    assert user_path("cache", "unsaved") == earlier
    assert user_path("cache", "other") == Path(home, "Library", "Caches", "engine3d", "other")
    user_path("cache", "other").parent.mkdir(parents=True)
    (user_path("cache", "other").parent / "unsaved").mkdir()
    assert user_path("cache", "unsaved") != earlier
