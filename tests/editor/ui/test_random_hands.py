"""Random hands on the editor: no panel fails, all is undone and done again, files hold all."""

import random

import pytest
from editor.ui.random_hands import Hands
from viewer.shown_models import write_models


@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
@pytest.mark.parametrize("seed", range(2))
def test_hands_do_no_harm(seed, editor, tmp_path, monkeypatch):
    (models := tmp_path / "models").mkdir()
    write_models(models)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(models)
    hands = Hands(random.Random(seed), editor, models)
    for _ in range(40):
        hands.act()
    hands.check_rest()
    hands.check_history()
    hands.check_file(tmp_path)
    hands.check_layout()
