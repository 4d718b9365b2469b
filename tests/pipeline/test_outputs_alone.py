"""Each output alone, and beside one other, is what it is beside all others, in every mode.

What is not asked for is not computed, so that each set of outputs takes another way through a tile;
and where things cover all of a tile, nothing is filled beforehand.
"""

from typing import get_args

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d.choices import Mode
from engine3d.rendering.frame import OUTPUTS

SIZE = (80, 70)  # a whole tile, and parts of others


@pytest.fixture(scope="module")
def scene():
    scene = e3d.Scene(background=e3d.linear(0.1, 0.2, 0.3))
    sphere, box = e3d.icosphere(1.0, subdivisions=3), e3d.box()
    sphere.materials = [
        e3d.Material(
            color=e3d.linear(0.5, 0.6, 0.7), emissive=e3d.linear(1, 0.5, 0.2), roughness=0.4
        )
    ]
    box.materials = [e3d.Material(color=(1.0, 1.0, 1.0, 0.5), alpha_mode="blend")]
    scene.add(sphere)
    scene.add(box, translation=(0.2, 0.1, 0.3))
    scene.add(e3d.DirectionalLight(direction=(-1, -2, -3)))
    return scene


@pytest.mark.parametrize("distance", [4.0, 1.2], ids=["apart", "covering"])
@pytest.mark.parametrize("mode", get_args(Mode))
def test_outputs_do_not_depend_on_each_other(scene, mode, distance):
    camera = e3d.PerspectiveCamera(), e3d.linalg.translation((0.0, 0.0, distance))
    sets = [(name,) for name in OUTPUTS]
    sets += [(name, other) for name in ("color", "radiance") for other in OUTPUTS if other != name]
    with Renderer(SIZE, threads=1) as renderer:
        whole = renderer.render(scene, camera, mode=mode, outputs=OUTPUTS)
        for outputs in sets:
            frame = renderer.render(scene, camera, mode=mode, outputs=outputs)
            for name in outputs:
                same = np.array_equal(getattr(frame, name), getattr(whole, name))
                assert same, f"{name} of {', '.join(outputs)}"
