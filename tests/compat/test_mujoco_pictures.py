"""Pictures in MuJoCo's manner: geometry, light, passes, of scenes that are made here."""

import gc
import multiprocessing
import os
import sys
import threading

import numpy as np
import pytest
from compat.mujoco_rules import light_of, pixel_of

from engine3d import Engine3DWarning, backends
from engine3d.errors import BackendError

os.environ.setdefault("MUJOCO_GL", "disable")
mujoco = pytest.importorskip("mujoco", exc_type=ImportError)

from engine3d.compat.mujoco import Renderer  # noqa: E402

SIZE = 96
_PLAIN = {"mjRND_SHADOW": 0, "mjRND_REFLECTION": 0, "mjRND_SKYBOX": 0}


def _model(world, asset="", visual=""):
    return mujoco.MjModel.from_xml_string(
        f"<mujoco><visual><headlight ambient='.2 .2 .2' diffuse='.4 .4 .4' specular='.3 .3 .3'/>"
        f"<global fovy='45' offwidth='640' offheight='640'/>{visual}</visual>"
        f"<asset>{asset}</asset><worldbody>{world}</worldbody></mujoco>"
    )


def _drawn(model, mode="rgb", flags=None, width=SIZE, height=SIZE, camera=-1, add=None):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Renderer(model, height, width) as renderer:
        for _ in range(2):  # planes without ends move with the camera of the update before
            renderer.update_scene(data, camera)
        for name, value in (flags or {}).items():
            renderer.scene.flags[getattr(mujoco.mjtRndFlag, name)] = value
        if add is not None:
            add(renderer.scene)
        if mode == "depth":
            renderer.enable_depth_rendering()
        if mode == "segmentation":
            renderer.enable_segmentation_rendering()
        return renderer.render(), renderer.scene


_CAMERA = "<camera name='c' pos='{}' xyaxes='1 0 0 0 {} {}'/>"


def _looking_down(height=3.0):
    return f"<camera name='c' pos='0 0 {height}' xyaxes='1 0 0 0 1 0'/>"


@pytest.mark.parametrize("seed", range(4))
def test_light_of_a_box_is_that_of_its_corners(seed):
    rng = np.random.default_rng(seed)
    rgb, emission, shine = rng.uniform(0.1, 0.8, 3), rng.uniform(0, 0.2), rng.uniform(0, 1)
    material = (
        f"<material name='m' rgba='{rgb[0]} {rgb[1]} {rgb[2]} 1' emission='{emission}' "
        f"specular='{rng.uniform(0, 0.6)}' shininess='{shine}'/>"
    )
    spot = (
        f"<light pos='{rng.uniform(-1, 1)} .4 2' dir='0 0 -1' cutoff='60' "
        f"exponent='{rng.integers(0, 9)}' "
        f"attenuation='1 .1 .05' diffuse='.5 .4 .3' castshadow='false'/>"
    )
    box = "<geom type='box' size='.8 .8 .1' material='m'/>"
    model = _model(box + spot + _looking_down(), material, "<quality numquads='1' offsamples='0'/>")
    picture, scene = _drawn(model, flags=_PLAIN, camera="c")
    corners = np.array([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]) * [0.8, 0.8, 0.1]
    colors = light_of(scene, scene.geoms[0], corners, np.tile([0.0, 0, 1], (4, 1))) * 255
    pixels, _ = pixel_of(scene, corners, SIZE, SIZE)
    rows, columns = np.mgrid[20:76, 20:76]
    # The face is seen straight on, so that shares of its corners are linear in pixels
    u = (columns + 0.5 - pixels[0, 0]) / (pixels[1, 0] - pixels[0, 0])
    v = (rows + 0.5 - pixels[0, 1]) / (pixels[3, 1] - pixels[0, 1])
    first = (u + v <= 1)[..., None]  # the diagonal runs from the second corner to the fourth
    below = (
        colors[0] + u[..., None] * (colors[1] - colors[0]) + v[..., None] * (colors[3] - colors[0])
    )
    above = colors[2] + (1 - u)[..., None] * (colors[3] - colors[2])
    above = above + (1 - v)[..., None] * (colors[1] - colors[2])
    wanted = np.floor(np.where(first, below, above) + 0.5)
    assert np.abs(picture[20:76, 20:76] - wanted).max() <= 1


def test_depth_is_metric_along_the_view_axis():
    model = _model("<geom type='plane' size='5 5 1'/>" + _looking_down())
    depth, _ = _drawn(model, "depth", camera="c")
    assert depth.dtype == np.float32
    assert np.abs(depth - 3).max() < 1e-5


def test_segmentation_names_objects_and_background():
    world = "<geom type='sphere' size='.3'/><site type='box' size='.1 .1 .1' pos='.7 0 0'/>"
    seen, _ = _drawn(_model(world + _looking_down()), "segmentation", camera="c")
    assert seen.shape == (SIZE, SIZE, 2)
    assert seen.dtype == np.int32
    pairs = {tuple(pair) for pair in seen.reshape(-1, 2).tolist()}
    assert pairs == {(-1, -1), (0, mujoco.mjtObj.mjOBJ_GEOM), (0, mujoco.mjtObj.mjOBJ_SITE)}
    assert tuple(seen[SIZE // 2, SIZE // 2]) == (0, mujoco.mjtObj.mjOBJ_GEOM)


@pytest.mark.parametrize("kind", ["sphere", "capsule", "ellipsoid", "cylinder", "box"])
@pytest.mark.parametrize("seed", range(3))
def test_shapes_cover_what_rays_hit(kind, seed):
    rng = np.random.default_rng(seed)
    size, turn = rng.uniform(0.2, 0.5, 3), rng.normal(size=4)
    world = (
        f"<geom type='{kind}' size='{size[0]} {size[1]} {size[2]}' "
        f"quat='{' '.join(map(str, turn))}'/>" + _looking_down()
    )
    visual = "<quality numslices='96' numstacks='64'/>"
    model = _model(world, visual=visual)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    depth, scene = _drawn(model, "depth", camera="c")
    half = scene.camera[0].frustum_top / scene.camera[0].frustum_near
    found, number = np.zeros((SIZE, SIZE)), np.zeros(1, np.int32)
    for row in range(SIZE):
        for column in range(SIZE):
            x, y = ((column + 0.5) / SIZE * 2 - 1) * half, (1 - (row + 0.5) / SIZE * 2) * half
            ray = np.array([x, y, -1.0])
            found[row, column] = mujoco.mj_ray(
                model, data, np.array([0, 0, 3.0]), ray, None, 1, -1, number
            )
    hit, seen = found >= 0, depth < 10
    assert (hit != seen).sum() <= 12  # polygons for round outlines
    both = hit & seen
    assert both.sum() > 100
    assert np.quantile(np.abs(depth - found)[both], 0.98) < 0.01


def test_shadows_are_where_rays_to_the_light_are_hit():
    world = (
        "<geom type='plane' size='2 2 1' rgba='.5 .5 .5 1'/>"
        "<geom type='sphere' size='.3' pos='.2 .1 .8'/>"
        "<light directional='true' pos='0 0 3' dir='.3 .2 -1' diffuse='.4 .4 .4' specular='0 0 0'/>"
    )
    model = _model(
        world + _looking_down(4), visual="<quality offsamples='0' numslices='96' numstacks='64'/>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    lit, scene = _drawn(model, camera="c")
    without, _ = _drawn(model, flags={"mjRND_SHADOW": 0}, camera="c")
    seen, _ = _drawn(model, "segmentation", camera="c")
    half = scene.camera[0].frustum_top / scene.camera[0].frustum_near * 4
    wrong = shaded = 0
    number = np.zeros(1, np.int32)
    for row, column in np.argwhere(seen[..., 0] == 0):
        x, y = ((column + 0.5) / SIZE * 2 - 1) * half, (1 - (row + 0.5) / SIZE * 2) * half
        if np.hypot(x - 0.44, y - 0.26) > 0.45:
            continue  # maps are read without their border: far off, the floor shadows itself
        distance = mujoco.mj_ray(
            model, data, np.array([x, y, 1e-3]), np.array([-0.3, -0.2, 1.0]), None, 1, -1, number
        )
        is_dark = int(lit[row, column, 0]) < int(without[row, column, 0]) - 20
        wrong += (distance >= 0) != is_dark
        shaded += is_dark
    assert shaded > 50
    assert wrong <= 6


def test_a_sheet_is_blended_twice():
    world = "<geom type='box' size='.5 .5 .01' rgba='1 1 1 .5'/>" + _looking_down()
    material = "<material name='w' emission='1' rgba='1 1 1 .5'/>"
    model = _model(world.replace("rgba='1 1 1 .5'", "material='w'"), material)
    picture, _ = _drawn(model, flags=_PLAIN, camera="c")
    assert picture[SIZE // 2, SIZE // 2].tolist() == [192, 192, 192]
    picture, _ = _drawn(model, flags={**_PLAIN, "mjRND_ADDITIVE": 1}, camera="c")
    assert picture[SIZE // 2, SIZE // 2].tolist() == [128, 128, 128]


def test_a_floor_mirrors_what_stands_on_it():
    material = (
        "<material name='f' rgba='.1 .1 .1 1' reflectance='.5' specular='0'/>"
        "<material name='r' rgba='1 0 0 1' emission='1' specular='0'/>"
    )
    world = (
        "<geom type='plane' size='2 2 1' material='f'/>"
        "<geom type='box' size='.3 .3 .3' pos='0 0 .5' material='r'/>"
        "<camera name='c' pos='0 -3 1.2' xyaxes='1 0 0 0 .37 .93'/>"
    )
    model = _model(world, material)
    mirrored, _ = _drawn(model, camera="c")
    plain, _ = _drawn(model, flags={"mjRND_REFLECTION": 0}, camera="c")
    seen, _ = _drawn(model, "segmentation", camera="c")
    floor = seen[..., 0] == 0
    redder = (mirrored[..., 0].astype(int) - plain[..., 0] > 90) & floor
    assert redder.sum() > 150
    assert (
        mirrored[~floor & (seen[..., 0] == 1)] == plain[~floor & (seen[..., 0] == 1)]
    ).mean() > 0.98


def test_four_samples_smooth_edges():
    world = "<geom type='box' size='.5 .5 .1' euler='0 0 30' rgba='1 1 1 1'/>" + _looking_down()
    smooth, _ = _drawn(_model(world), camera="c")
    hard, _ = _drawn(_model(world, visual="<quality offsamples='0'/>"), camera="c")
    assert len(np.unique(hard[..., 0])) < len(np.unique(smooth[..., 0]))


def test_geoms_that_a_program_adds_are_drawn():
    def add(scene):
        geom = scene.geoms[scene.ngeom]
        mujoco.mjv_initGeom(
            geom,
            mujoco.mjtGeom.mjGEOM_SPHERE,
            [0.3, 0, 0],
            [0, 0, 0],
            np.eye(3).ravel(),
            [1, 0, 0, 1],
        )
        scene.ngeom += 1

    picture, _ = _drawn(
        _model("<geom size='.01' pos='9 9 9'/>" + _looking_down()), camera="c", add=add
    )
    assert picture[SIZE // 2, SIZE // 2, 0] > 60
    assert picture[SIZE // 2, SIZE // 2, 1] < picture[SIZE // 2, SIZE // 2, 0] / 2


def test_labels_are_a_warning():
    def add(scene):
        scene.geoms[0].label = "name"

    with pytest.warns(Engine3DWarning, match="labels"):
        _drawn(_model("<geom size='.1'/>" + _looking_down()), camera="c", add=add)


# ---- backends ----


def _numbers(rng, low, high, count):
    return " ".join(f"{v:.3f}" for v in rng.uniform(low, high, count))


def _any_scene(seed):
    """Return a scene of all that kernels do: textures, cubes, sky, lights, shadows, mirrors."""
    rng = np.random.default_rng(seed)
    asset = (
        "<texture name='t0' type='2d' builtin='checker' width='32' height='16' rgb1='.1 .2 .3' "
        "rgb2='.8 .9 .6' mark='cross'/>"
        "<texture name='t1' type='cube' builtin='gradient' width='16' height='16' "
        "rgb1='1 .5 .2' rgb2='.1 .1 .6' mark='random' random='.1'/>"
        "<texture name='t2' type='2d' builtin='flat' width='8' height='8' rgb1='.5 .4 .3' "
        "rgb2='.2 .9 .1' mark='edge' colorspace='sRGB'/>"
        "<texture type='skybox' builtin='gradient' rgb1='.3 .5 .7' rgb2='0 0 .2' width='16' "
        "height='96'/><mesh name='m' vertex='0 0 0 .4 0 0 0 .4 0 0 0 .4'/>"
    )
    for k in range(3):
        asset += (
            f"<material name='m{k}' texture='t{k}' texrepeat='{_numbers(rng, 0.5, 5, 2)}' "
            f"texuniform='{('true', 'false')[k % 2]}' shininess='{rng.uniform():.3f}' "
            f"reflectance='{0.4 * (k == 0)}' emission='{rng.uniform(0, 0.3):.3f}'/>"
        )
    world = "<geom type='plane' size='2 2 .2' material='m0' contype='0' conaffinity='0'/>"
    for kind in ("sphere", "capsule", "box", "cylinder", "ellipsoid", "mesh", "box", "sphere"):
        size = "mesh='m'" if kind == "mesh" else f"size='{_numbers(rng, 0.05, 0.4, 3)}'"
        looks = f"material='m{rng.integers(3)}'" if rng.random() < 0.5 else ""
        alpha = rng.choice([1, 1, 1, 0.4])
        world += (
            f"<geom type='{kind}' {size} pos='{_numbers(rng, -1, 1, 3)}' {looks} "
            f"euler='{_numbers(rng, -180, 180, 3)}' rgba='{_numbers(rng, 0, 1, 3)} {alpha}'/>"
        )
    for k in range(3):
        world += (
            f"<light directional='{('true', 'false')[k % 2]}' "
            f"castshadow='{('true', 'false')[k // 2]}' "
            f"pos='{_numbers(rng, -1, 1, 2)} 3' dir='{_numbers(rng, -0.4, 0.4, 2)} -1' "
            f"cutoff='{rng.uniform(10, 60):.1f}' attenuation='1 .1 .02'/>"
        )
    return _model(world, asset, "<quality shadowsize='512' offsamples='4'/>")


@pytest.mark.parametrize("seed", range(8))
def test_backends_draw_the_same(seed, monkeypatch):
    model = _any_scene(seed)
    flags = {"mjRND_FOG": seed % 2, "mjRND_ADDITIVE": seed == 3, "mjRND_WIREFRAME": seed == 4}
    size = {"width": 50 + 3 * seed, "height": 37 + seed}
    found = {}
    for backend in backends():
        monkeypatch.setenv("ENGINE3D_BACKEND", backend)
        monkeypatch.setenv("ENGINE3D_THREADS", str(1 + len(found) % 3))
        for mode in ("rgb", "depth", "segmentation"):
            picture = _drawn(model, mode, flags, **size)[0]
            np.testing.assert_array_equal(picture, found.setdefault(mode, picture), backend)
    assert found["rgb"].std() > 5


def test_an_unknown_backend_is_an_error(monkeypatch):
    monkeypatch.setenv("ENGINE3D_BACKEND", "mmx")
    with pytest.raises(BackendError, match="ENGINE3D_BACKEND='mmx' is unknown"):
        Renderer(_any_scene(0), 8, 8)


# ---- threads, processes, memory ----


def _scenery():
    material = (
        "<texture name='t' type='2d' builtin='checker' width='64' height='64' rgb1='.2 .3 .4' "
        "rgb2='.7 .8 .9'/><texture type='skybox' builtin='gradient' rgb1='.3 .5 .7' rgb2='0 0 0' "
        "width='32' height='192'/><material name='f' texture='t' texrepeat='5 5' reflectance='.3'/>"
    )
    world = "<geom type='plane' size='3 3 1' material='f'/><light pos='1 -1 3' dir='-.3 .3 -1'/>"
    rng = np.random.default_rng(5)
    for kind in ("sphere", "capsule", "box", "cylinder", "ellipsoid"):
        x, y, r, g, b = rng.uniform(0, 1, 5)
        world += (
            f"<geom type='{kind}' size='.2 .25 .3' pos='{2 * x - 1} {2 * y - 1} .4' "
            f"rgba='{r} {g} {b} {1 if kind != 'box' else 0.5}'/>"
        )
    return _model(world, material)


def _bytes(_=None):
    return _drawn(_scenery())[0].tobytes()


def test_threads_draw_the_same():
    wanted, found = _bytes(), []
    threads = [threading.Thread(target=lambda: found.append(_bytes())) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [wanted] * 4


@pytest.mark.skipif(sys.platform == "win32", reason="needs fork")
def test_processes_draw_the_same():
    wanted = _bytes()
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert set(pool.map(_bytes, range(4))) == {wanted}


def test_nothing_leaks_over_many_pictures():
    resource = pytest.importorskip("resource", exc_type=ImportError)
    model = _scenery()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    used = []
    for _ in range(3):
        for _ in range(40):
            with Renderer(model, 64, 64) as renderer:
                for _ in range(5):
                    renderer.update_scene(data)
                    renderer.render()
        gc.collect()
        used.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
    assert used[2] - used[1] < 4096  # KiB
