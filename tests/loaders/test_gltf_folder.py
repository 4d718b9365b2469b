"""Small pictures of a folder of glTF files, one after the other in one process, as a file manager
draws them: each file shows or is refused, and nothing of it stays behind.
"""

import gc
import os
import sys
import weakref

import numpy as np
import pytest
from loaders.test_gltf_corpus import cases, loaded, needs_package
from plain_picture import Renderer

import engine3d as e3d
from engine3d.errors import Engine3DError
from engine3d.model.materials.material import textures_of

SIZE = 256
# A second round of files may take more, since what is free lies elsewhere; without the weak
# references below, each round would take ten times as much.
MOST_GROWTH = 200 << 20

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc"),
]


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def held_by(scene):
    """Weak references to what takes memory."""
    meshes = [getattr(node.object, "mesh", node.object) for node in scene.nodes]
    meshes = [mesh for mesh in meshes if isinstance(mesh, e3d.Mesh)]
    materials = [material for mesh in meshes for material in mesh.materials]
    textures = [texture for material in materials for texture in textures_of(material).values()]
    return [weakref.ref(thing) for thing in (scene, *meshes, *textures)]


def draw(renderer, case):
    """Whether anything shows of a file; the error of one that is refused; what it held."""
    scene = loaded(e3d.load_scene, case)
    if isinstance(scene, Engine3DError):
        return scene, []
    frame = renderer.render(
        scene, outputs=("color", "object_id"), transparent_outputs=True, cull="none"
    )
    assert frame.color.shape == (SIZE, SIZE, 4)
    return bool((frame.object_id >= 0).any()), held_by(scene)


def test_a_folder_of_files_is_drawn_and_forgotten():
    files = [parameter.values[0] for parameter in cases("models", "own")]
    if not files:
        pytest.skip("needs the glTF corpus in ../shared (or ENGINE3D_SHARED)")
    assert len(files) >= 100
    after = []
    with Renderer((SIZE, SIZE)) as renderer:
        for chosen in (files, files[::2], files[::2]):
            held = []
            for case in chosen:
                shows, refs = draw(renderer, case)
                held += refs
                if not needs_package(shows):
                    check(case, shows)
            renderer.render(e3d.Scene())
            gc.collect()
            assert not [ref() for ref in held if ref() is not None]
            after.append(resident())
    print([round(size / 2**20) for size in after], "MiB")
    assert after[2] - after[1] < MOST_GROWTH
    assert np.all(np.diff(after) < 2 * MOST_GROWTH)


def check(case, shows):
    """A file with something in it shows, or is refused with a word on why."""
    expected = case.get("expect")
    if isinstance(shows, Engine3DError):
        assert expected is None or case.get("outcome") in ("error", "either", "warn"), str(shows)
    elif expected and expected.get("scene_triangles"):
        assert shows, case["file"]
