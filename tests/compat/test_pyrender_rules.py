"""The C stage of pyrender's pictures gives what its rules say, to the bit, on random scenes."""

import numpy as np
import pytest
from compat.pyrender_rules import CENTRE, F, picture

from engine3d._native import pyrender as native

SIZE = 18, 14
KINDS = ("directional", "point", "spot")
SHADINGS = {"lit": native.LIT, "flat": native.FLAT, "plain": native.PLAIN}
WRAPS = {"repeat": native.REPEAT, "clamp": native.CLAMP, "mirror": native.MIRROR}


def random_texture(rng, channels):
    height, width = rng.integers(1, 9, 2)
    levels = []
    while True:
        levels.append(rng.integers(0, 256, (height, width, channels)).astype(np.uint8))
        if max(height, width) == 1:
            break
        height, width = max(height // 2, 1), max(width // 2, 1)
    wrap = rng.choice(list(WRAPS), 2).tolist()
    linear_near, linear_far, blends = (rng.random(3) < 0.7).tolist()
    values = {"levels": levels, "wrap": wrap, "linear_near": linear_near}
    values |= {"linear_far": linear_far, "blends": blends}
    values["native"] = native.NativeTexture(
        levels, *(WRAPS[one] for one in wrap), linear_near, linear_far, blends
    )
    return values


def random_draw(rng, lights):
    count = int(rng.integers(5, 12))
    draw = {"positions": rng.normal(size=(count, 3)).astype(F)}
    draw["indices"] = np.array([rng.permutation(count)[:3] for _ in range(14)], np.int32)
    is_calm = rng.random() < 0.4
    normals = rng.normal(size=(count, 3)) * (0.02 if is_calm else 1.0) + (1.0 if is_calm else 0.0)
    draw["normals"] = normals.astype(F) if rng.random() < 0.8 else None
    colors = rng.random((count, 4)) * (0.015 if is_calm else 1.0)
    draw["colors"] = colors.astype(F) if rng.random() < 0.5 else None
    draw["uvs"] = (rng.normal(size=(count, 2)) * 2).astype(F) if rng.random() < 0.4 else None
    channels = (4, 2, 3, 1, 3)
    draw["textures"] = [random_texture(rng, c) if rng.random() < 0.6 else None for c in channels]
    draw["world"] = np.eye(4)
    draw["world"][:3] += rng.normal(size=(3, 4)) * 0.4
    draw["color"] = rng.random(4).astype(F)
    draw["metallic"], draw["roughness"] = rng.random(2).astype(F)
    draw["emissive"] = (rng.random(3) * (rng.random() < 0.3)).astype(F)
    draw["lights"] = rng.permutation(lights)[: rng.integers(0, lights + 1)].tolist()
    return draw


def random_light(rng):
    light = {"kind": str(rng.choice(KINDS)), "color": (rng.random(3) * 4).astype(F)}
    light["position"] = (rng.normal(size=3) * 2).astype(F)
    direction = rng.normal(size=3)
    light["direction"] = (direction / np.linalg.norm(direction)).astype(F)
    light["scale"], light["offset"] = F(3.0), F(-1.5)
    light["map"] = light["shadow_from_world"] = None
    if light["kind"] != "point" and rng.random() < 0.5:
        light["map"] = rng.uniform(-1, 1, (8, 8)).astype(F)
        light["shadow_from_world"] = rng.normal(size=(4, 4)) * 0.3 + np.diag([0, 0, 0, 3.0])
    return light


def random_frame(rng, shading):
    near, slope = 0.1, 1.2
    projection = np.diag([slope, slope, -1.02, 0.0])
    projection[0, 2], projection[2, 3], projection[3, 2] = 0.1, -0.202, -1.0
    view = np.eye(4)
    view[2, 3] = -4.0
    lights = [random_light(rng) for _ in range(3)]
    frame = {"size": SIZE, "shading": shading, "clip_from_world": projection @ view}
    frame["eye"], frame["ambient"] = np.array([0, 0, 4], F), rng.random(3).astype(F)
    frame["background"] = rng.random(4).astype(F)
    far = float(rng.choice([10.1, np.inf]))
    frame |= {"near": near, "far": far, "straight": far < np.inf and rng.random() < 0.3}
    frame["depth_place"] = int(rng.choice([CENTRE, 0]))
    frame |= {"lights": lights, "draws": [random_draw(rng, len(lights)) for _ in range(3)]}
    return frame


def random_shown(rng, frame, places):
    """Which draw and triangle each place shows: patches of them, and some that differ."""
    width, height = frame["size"]
    patches = rng.integers(-1, 3, (4, 4))
    shown = np.empty((places, height, width, 2), int)
    shown[..., 0] = patches.repeat(5, 0).repeat(5, 1)[:height, :width]
    shown[..., 1] = rng.integers(0, 14, (height, width))
    differs = rng.random((places, height, width)) < 0.3
    shown[differs] = rng.integers(-1, 14, (differs.sum(), 2)) % (4, 14) - (1, 0)
    shown[shown[..., 0] < 0] = -1
    return shown


def native_picture(frame, shown, threads):
    stage = native.NativePicture()
    for light in frame["lights"]:
        kind = getattr(native, light["kind"].upper())
        stage.add_light(
            *(kind, light["color"], light["position"], light["direction"]),
            *(light["scale"], light["offset"], light["map"], light["shadow_from_world"]),
        )
    for draw in frame["draws"]:
        names = ("positions", "normals", "uvs", "colors")
        shape = native.NativeShape(
            native.TRIANGLES, draw["indices"].ravel(), *(draw[name] for name in names)
        )
        first = stage.add_lights_of_draws(draw["lights"])
        textures = tuple(one and one["native"] for one in draw["textures"])
        stage.add_draw(
            *(shape, draw["world"], False, False, False, draw["color"], draw["metallic"]),
            *(draw["roughness"], draw["emissive"], textures, first, len(draw["lights"])),
        )
    ids = np.ascontiguousarray(np.moveaxis(shown, 3, 0), np.int32)
    places = [(objects, triangles, None) for objects, triangles in zip(*ids, strict=True)]
    stage.add_visible(places, np.arange(3, dtype=np.int32))
    width, height = frame["size"]
    color, depth = np.empty((height, width, 4), np.uint8), np.empty((height, width), F)
    stage.render(
        *(1 if len(shown) == 1 else 4, SHADINGS[frame["shading"]], frame["clip_from_world"]),
        *(frame["eye"], frame["ambient"], frame["background"], 1.0, frame["near"], frame["far"]),
        *(bool(frame["straight"]), frame["depth_place"], threads, color, depth),
    )
    return color, depth


@pytest.mark.parametrize("places", [1, 5])
@pytest.mark.parametrize("shading", SHADINGS)
def test_visible_triangles_follow_the_rules(shading, places):
    for seed in range(6 if shading == "lit" else 2):
        rng = np.random.default_rng((seed, places))
        frame = random_frame(rng, shading)
        shown = random_shown(rng, frame, places)
        with np.errstate(all="ignore"):
            color, depth = picture(frame, shown)
        for threads in (1, 3):
            drawn = native_picture(frame, shown, threads)
            assert np.array_equal(drawn[0], color), (seed, threads)
            assert np.array_equal(drawn[1], depth), (seed, threads)
        assert len(np.unique(color)) > 20 or shading == "plain"
