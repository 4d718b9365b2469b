"""Random hands on the viewer: nothing fails, hangs, grows or stays other than it was."""

import random
import warnings

import pytest
from viewer.random_hands import Hands, check_inverses
from viewer.shown_models import demo, write_models

from engine3d.apps.desktop.recent_files import RecentFiles
from engine3d.errors import Engine3DWarning


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    folder = tmp_path_factory.mktemp("models")
    write_models(folder)
    return folder


@pytest.fixture(autouse=True)
def place(tmp_path, monkeypatch):
    """The folders of the user, and the present one, to which pictures are written."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME", "HOME"):
        monkeypatch.setenv(variable, str(tmp_path))
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", Engine3DWarning)
        yield


@pytest.mark.parametrize("name", [None, "cube", "asc"])
@pytest.mark.parametrize("seed", [0, 1])
def test_hands_do_no_harm(seed, name, models):
    rng = random.Random(f"{seed} {name}")
    with Hands(rng, models, None if name is None else demo(name)) as hands:
        for _ in range(25):
            hands.act()
        check_inverses(hands, rng, 3)
        hands.check_rest()
        RecentFiles().paths()  # a damaged list would be told
