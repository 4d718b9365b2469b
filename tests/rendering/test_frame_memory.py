"""What a frame may take of memory: whatever goes by a number in a scene or an option is counted.

Limits are lowered, so that each case is told before anything of its size is allocated, and is drawn
as before where the limit is just enough.
"""

import random
import re
import tracemalloc

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.rendering import _frame_memory, options
from engine3d.rendering.frame import OUTPUTS
from engine3d.rendering.passes import all_passes as _passes
from engine3d.rendering.passes.protocol import Tools
from engine3d.rendering.passes.shadow_maps import ShadowMaps

LIGHTS = {
    "DirectionalLight": lambda **shadow: e3d.DirectionalLight(direction=(-1, -2, -1), **shadow),
    "PointLight": lambda **shadow: e3d.PointLight(**shadow),
    "SpotLight": lambda **shadow: e3d.SpotLight(**shadow),
}
OPTIONS = {
    "bloom": ({}, {"bloom": 1.0}),
    "ambient occlusion": ({}, {"ambient_occlusion": True}),
    "4 samples": ({"samples": 4}, {}),
    "multisampling": ({"samples": 8, "antialiasing": "msaa", "threads": 64}, {}),
}


def scene_of(lights=()):
    scene = e3d.Scene()
    scene.add(e3d.box())
    for number, light in enumerate(lights):
        scene.add(light, translation=(2.0, 2.0, 2.0 + number))
    return scene


def maps_of(renderer):
    """The maps of shadows that a renderer keeps, by light."""
    passes = renderer._painter.passes._all
    return next(one for one in passes if isinstance(one, ShadowMaps))._kept


def plan_of(options, size, threads):
    tools = Tools(None, None, None, 0, threads, True, (1, 0), None, None)
    passes = [make(tools) for make in _passes.PASSES]
    return _passes.plan_of(passes, options, options.outputs, size)


def allow(monkeypatch, size, a_pixel=0):
    monkeypatch.setattr(options, "MAX_FRAME_BYTES", size)
    monkeypatch.setattr(_frame_memory, "BYTES_A_PIXEL", a_pixel)


def least_limit(draw, monkeypatch):
    """The lowest limit that `draw` is allowed under, and what was said under half of it."""
    low, high = 0, 1 << 40
    while low < high:
        middle = (low + high) // 2
        allow(monkeypatch, middle)
        try:
            draw()
            high = middle
        except e3d.InvalidArgumentError:
            low = middle + 1
    allow(monkeypatch, low // 2)
    with pytest.raises(e3d.InvalidArgumentError) as refused:
        draw()
    allow(monkeypatch, low)
    return low, str(refused.value)


@pytest.mark.parametrize("case", range(8))
def test_maps_of_shadows_are_counted(case, monkeypatch):
    """By their bytes: every kind of light, several kinds and sizes beside each other."""
    r = random.Random(case)
    kinds = [r.choice(list(LIGHTS)) for _ in range(r.randint(1, 4))]
    sizes = [r.choice((32, 64, 100, 256)) for _ in kinds]
    lights = [LIGHTS[k](shadow="map", shadow_map_size=s) for k, s in zip(kinds, sizes, strict=True)]
    with Renderer((16, 16)) as renderer:
        frame = renderer.render(scene_of(lights))
        maps = maps_of(renderer).values()
        size = sum(kept.depths.nbytes for kept in maps) + 16 * 16 * 8
    with Renderer((16, 16)) as renderer:
        allow(monkeypatch, size - 1)
        with pytest.raises(e3d.InvalidArgumentError, match="shadow_map_size") as refused:
            renderer.render(scene_of(lights))
        assert maps_of(renderer) == {}
        largest = max(zip(sizes, kinds, strict=True))[0]
        assert f"{largest}x{largest}" in str(refused.value) and "\n" not in str(refused.value)
        allow(monkeypatch, size)
        assert np.array_equal(renderer.render(scene_of(lights)).color, frame.color)


def test_a_few_bytes_of_a_scene_file_take_no_gigabytes(tmp_path):
    path = tmp_path / "lamps.e3d.json"
    scene_of([e3d.PointLight(shadow="map", shadow_map_size=8192)] * 4).save(path)
    scene = e3d.load_scene(path)
    tracemalloc.start()
    try:
        with pytest.raises(
            e3d.InvalidArgumentError, match=r"6\.0 GiB for shadow maps of 8192x8192"
        ):
            render(scene, size=(16, 16))
        assert tracemalloc.get_traced_memory()[1] < 32 << 20
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("sides", [(4096, 4096), (2048,) * 8])
def test_large_maps_are_no_error(sides):
    memory = _frame_memory.FrameMemory(1, 0, 1)
    options, size = e3d.RenderOptions(bloom=1.0, ambient_occlusion=True), (1920, 1080)
    memory.check(options.outputs, size, plan_of(options, size, 1).uses)
    memory.add_maps(("PointLight", 6, side) for side in sides)


@pytest.mark.parametrize("name", OPTIONS)
def test_what_options_take_is_named(name, monkeypatch):
    of_renderer, of_frame = OPTIONS[name]
    size = (64, 40)
    with Renderer(size, **{"threads": 1, **of_renderer}) as renderer:
        scene = scene_of()
        limit, said = least_limit(lambda: renderer.render(scene, **of_frame), monkeypatch)
        assert limit > 8 * size[0] * size[1]
        assert re.search(rf"B for [^,]*{name}", said.replace(f"{4 * 64 * 40} ", "4 "))


def test_exact_shadows_go_by_faces_in_all_their_places(monkeypatch):
    lamp = e3d.PointLight(shadow="exact")
    scene = scene_of([lamp])
    with Renderer((8, 8)) as renderer:
        one, _ = least_limit(lambda: renderer.render(scene), monkeypatch)
    poses = np.tile(np.eye(4, dtype=np.float32), (50, 1, 1))
    scene.add(e3d.InstancedMesh(e3d.box(), poses))
    with Renderer((8, 8)) as renderer:
        many, said = least_limit(lambda: renderer.render(scene), monkeypatch)
    assert many - 512 == 51 * (one - 512)
    assert "exact shadows (1 lights, 612 faces" in said


def test_outputs_are_no_larger_than_the_machine_has_memory(monkeypatch):
    monkeypatch.setattr(_frame_memory, "machine_memory", lambda: 100 * 50 * 4)
    with Renderer((100, 50)) as renderer:
        renderer.render(scene_of())
        for call in (renderer.render, renderer.prepare):
            with pytest.raises(
                e3d.InvalidArgumentError, match="outputs of a frame of 100x50 pixels"
            ):
                call(scene_of(), outputs=OUTPUTS)


def test_what_goes_by_the_picture_alone_always_fits():
    """Bloom and ambient occlusion of the largest picture, with the most threads and samples."""
    memory = _frame_memory.FrameMemory(1, 16, 256)
    glowing = e3d.RenderOptions(bloom=1.0, ambient_occlusion=True)
    size = 16384, 16384
    plan = plan_of(glowing, size, 256)
    assert {use.what for use in plan.uses} == {"bloom", "ambient occlusion"}
    assert memory.check((), size, plan.uses) == plan.uses + memory._uses_of(*size)


def test_the_limit_is_what_the_program_says(monkeypatch):
    """Once more after a refusal, and again where it is lowered between frames."""
    scene = scene_of([e3d.SpotLight(shadow="map", shadow_map_size=512)])
    with Renderer((8, 8)) as renderer:
        for limit, fits in ((1 << 20, False), (1 << 21, True), (1 << 20, False)):
            allow(monkeypatch, limit)
            if fits:
                renderer.render(scene)
            else:
                with pytest.raises(e3d.InvalidArgumentError, match="MAX_FRAME_BYTES"):
                    renderer.render(scene)


def test_what_mirrors_show_counts(monkeypatch):
    """Each of some mirrors draws shadow maps of its own."""
    light = e3d.PointLight(shadow="map", shadow_map_size=256)
    maps, counted = 6 * 4 * 256**2, []
    for mirrors in range(4):
        scene = scene_of([light])
        pane = e3d.plane()
        pane.materials = [e3d.Material(mirror=1.0)]
        for number in range(mirrors):
            scene.add(pane, translation=(0, -1 - 0.1 * number, 0))
        camera = e3d.PerspectiveCamera(1.0), e3d.look_at((0, 2, 3), (0, 0, 0))

        def draw(scene=scene, camera=camera):
            render(scene, camera, size=(64, 64), mirror_depth=1)

        counted.append(least_limit(draw, monkeypatch)[0])
        allow(monkeypatch, counted[-1])
        draw()
    steps = np.diff(counted)
    assert (steps >= maps).all() and (steps < 1.5 * maps).all()
