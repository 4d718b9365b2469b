"""Pictures beside those that MuJoCo drew with Mesa's llvmpipe, where they are at hand."""

import importlib
import os
import sys
from pathlib import Path

import pytest

os.environ.setdefault("MUJOCO_GL", "disable")
pytest.importorskip("mujoco", exc_type=ImportError)

from engine3d.compat.mujoco import Renderer

_FOLDER = Path(__file__).resolve().parents[3] / "shared" / "mujoco"
if not _FOLDER.exists():
    _FOLDER = Path(__file__).resolve().parents[4] / "shared" / "mujoco"
_FILES = sorted(_FOLDER.glob("references/*.npz"))

pytestmark = pytest.mark.skipif(not _FILES, reason="the reference pictures are not here")


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("path", _FILES, ids=lambda path: path.stem)
def test_pictures_are_within_the_bounds_of_a_drop_in(path, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)  # mujoco writes a log there
    monkeypatch.setattr(sys, "path", [str(_FOLDER), *sys.path])
    check, mujref = importlib.import_module("check"), importlib.import_module("mujref")
    reference = mujref.read_ref(path)
    scene = reference["meta"]["scene"]
    try:
        model = mujref.load_model(scene, str(_FOLDER))
    except FileNotFoundError as error:
        pytest.skip(str(error))
    run = mujref.Run(Renderer, model, mujref.restore(model, reference), scene)
    found = {kind: run.picture(kind) for kind in ("rgb", "depth", "seg") if kind in reference}
    run.close()
    figures = mujref.compare(reference, found)
    if not reference["meta"]["optional"]:
        faults = check.fails(scene["name"], figures, 2)
        if scene["name"] == "f13_inertia":  # two geoms in one place: rounding decides which shows
            assert figures["seg_diff_px"] <= 24
            faults = [fault for fault in faults if not fault.startswith("seg_diff_pct")]
        assert not faults
