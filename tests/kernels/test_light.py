"""light and combine against R27 and R31."""

import functools

import numpy as np
import pytest
from kernels.arithmetic import ONE, ZERO, clamp, dot, greatest, power, unit
from kernels.harness import all_backends, check_lanes, check_poisoned, hostile
from kernels.kernels import shown_of
from kernels.layouts import LIGHT, PAD
from kernels.surfaces import ROUNDS, fill, planes, random_batches

DIRECTIONAL, POINT = 0, 1
INVERSE_SQUARE, WINDOW = 0, 1
SHININESS = [0.0, 1.0, 5.5, 32.0, 1000.0, 1e-3]


def random_lights(rng, count):
    lights = np.zeros(count, LIGHT)
    lights["kind"] = rng.integers(0, 2, count)
    lights["falloff"] = rng.integers(0, 2, count)
    lights["color"] = rng.uniform(0, 12, (count, 3))
    lights["position"] = rng.uniform(-3, 3, (count, 3))
    towards = rng.normal(size=(count, 3))
    lights["to_light"] = towards / np.sqrt((towards**2).sum(axis=1, keepdims=True))
    lights["range"] = rng.choice([0.5, 2.0, 1e20, 3e-30], count)
    unlimited = (lights["falloff"] == INVERSE_SQUARE) & (rng.random(count) < 0.5)
    lights["range"][unlimited] = np.inf
    return lights


def reach_of(lights):
    """What the kernel reads of lights side by side: (5, lights and pad).

    Positions, squared ranges, and one over these.
    """
    reach = np.full((5, len(lights) + PAD), np.nan, np.float32)
    point = lights["kind"] == POINT
    reach[:3, : len(lights)] = np.where(point, lights["position"].T, np.float32(0))
    squares = lights["range"] * lights["range"]
    reach[3, : len(lights)] = np.where(point, squares, np.float32(np.nan))
    reach[4] = ONE / reach[3]
    return reach


def towards(light, position):
    """The unit vector to a light, its attenuation, and the samples that it reaches."""
    everywhere = np.ones(position[0].shape, bool)
    if light["kind"] == DIRECTIONAL:
        full = np.full(position[0].shape, ONE)
        return [full * component for component in light["to_light"]], full, everywhere
    d = [light["position"][k] - position[k] for k in range(3)]
    d2 = dot(d, d)
    range2 = light["range"] * light["range"]
    reached = ~(d2 >= range2)
    d2 = greatest(d2, np.float32(2.0**-40))
    inverse = ONE / np.sqrt(d2)
    if light["falloff"] == WINDOW:
        t = ONE - d2 * (ONE / range2)
        attenuation = t * t
    else:
        attenuation = ONE / d2
    return [component * inverse for component in d], attenuation, reached


def lit(lights, ambient, light_clamp, eye, shininess, position, normal):
    """R31: energy and shine, three arrays each."""
    energy = [np.full(position[0].shape, value) for value in ambient]
    shine = [np.zeros(position[0].shape, np.float32) for _ in range(3)]
    view = [np.full(position[0].shape, eye[k]) for k in range(3)]
    if eye[3]:
        view = unit([eye[k] - position[k] for k in range(3)])
    for light, shown in zip(lights, shown_of(lights), strict=True):
        direction, attenuation, reached = towards(light, position)
        facing = greatest(dot(normal, direction), ZERO)
        amount = attenuation * facing
        for k in range(3):
            energy[k] = np.where(reached, energy[k] + shown[k] * amount, energy[k])
        if shininess > 0:
            half = unit([direction[k] + view[k] for k in range(3)])
            highlight = power(greatest(dot(normal, half), ZERO), np.float32(shininess))
            amount = attenuation * np.where(facing > 0, highlight, ZERO)
            for k in range(3):
                shine[k] = np.where(reached, shine[k] + shown[k] * amount, shine[k])
    return [clamp(e, *light_clamp) for e in energy], shine


def random_normals(rng, batches):
    shape = batches.fields["normal"].shape
    normal = unit(planes(rng.normal(size=shape).astype(np.float32)))
    normal = np.stack(normal, axis=1)
    return np.where(rng.random(shape) < 0.02, hostile(rng, shape, rate=0.5), normal)


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def lit_batches(shininess):
    """Batches, the arguments of light, and the energy and shine that it must give."""
    made = []
    for seed in range(2):
        rng = np.random.default_rng(seed)
        batches = random_batches(rng)
        position = hostile(rng, batches.fields["position"].shape, 3.0, 0.03)
        normal = random_normals(rng, batches)
        lights = random_lights(rng, (6, 1)[seed])
        near = lights["position"][-1][:, None] + rng.integers(-5, 6, (3, 40)) * np.float32(2.0**-22)
        position[:, :, :40] = near  # on a light, and less than 2^-20 from it
        fill(batches, "position", position)
        fill(batches, "normal", normal)
        ambient = rng.random(3).astype(np.float32)
        light_clamp = np.float32([(0, np.inf), (0.1, 1)][seed])
        eye = np.float32([(0.5, 2, 4, 1), (0, 0.6, 0.8, 0)][seed])
        lighting = ambient, light_clamp, eye, shininess
        expected = lit(lights, *lighting, planes(position), planes(normal))
        made.append((batches, (lights.view(np.uint8), reach_of(lights), *lighting), expected))
    return made


@all_backends
@pytest.mark.parametrize("shininess", SHININESS)
def test_light(kernels, shininess):
    for template, arguments, (energy, shine) in lit_batches(shininess):
        batches = template.copy()
        for row in batches.rows:
            kernels.light(row, *arguments)
        counts = batches.fields["count"]
        for k in range(3):
            check_lanes(f"energy[{k}]", batches.fields["energy"][:, k], energy[k], counts)
            check_lanes(f"shine[{k}]", batches.fields["shine"][:, k], shine[k], counts)
        check_poisoned(batches.fields, ["weight", "r", "uv", "color", "lod"])
        batches.check_gaps()


@functools.lru_cache(maxsize=1)  # the backends of a case follow each other
def close_batches(count):
    """Batches of samples close together, so many lights, their energy at each sample."""
    rng = np.random.default_rng(count)
    batches = random_batches(rng)
    shape = batches.fields["position"].shape
    size = rng.choice([0.0, 0.01, 0.3], shape[0])[:, None, None]
    centre = rng.uniform(-3, 3, (shape[0], 3, 1))
    position = (centre + size * rng.uniform(-1, 1, shape)).astype(np.float32)
    normal = random_normals(rng, batches)
    lights = random_lights(rng, count)
    lights["range"] = np.where(np.isinf(lights["range"]), np.inf, rng.uniform(0.01, 2, count))
    edge = position[np.arange(count) % len(position), :, 0] - lights["position"]
    # a sample at the very end of the range
    exact = np.sqrt((edge**2).sum(axis=1)).astype(np.float32)
    lights["range"][::2] = np.where(np.isinf(lights["range"][::2]), np.inf, exact[::2])
    position[::50, 0] = np.nan  # nothing is left out
    batches.fields["position"], batches.fields["normal"] = position, normal
    ambient, light_clamp = np.float32([0.1, 0.2, 0.3]), np.float32([0, np.inf])
    lighting = ambient, light_clamp, np.float32([0.5, 2, 4, 1]), 0.0
    energy, _ = lit(lights, *lighting, planes(position), planes(normal))
    return batches, (lights.view(np.uint8), reach_of(lights), *lighting), energy


@all_backends
@pytest.mark.parametrize("count", [5, 270])
def test_lights_out_of_reach(kernels, count):
    """Most lights are left out, and never one that adds anything."""
    template, arguments, energy = close_batches(count)
    batches = template.copy()
    for row in batches.rows:
        kernels.light(row, *arguments)
    for k in range(3):
        got = batches.fields["energy"][:, k]
        check_lanes(f"energy[{k}]", got, energy[k], batches.fields["count"])


@all_backends
def test_without_lights(kernels):
    """Ambient light alone, clamped."""
    batches = random_batches(np.random.default_rng(0))
    ambient, nothing = np.float32([0.05, 0.5, 5]), np.zeros(0, np.uint8)
    reach, eye = reach_of(nothing.view(LIGHT)), np.float32([0, 0, 1, 0])
    for row in batches.rows:
        kernels.light(row, nothing, reach, ambient, np.float32([0.1, 1]), eye, 0.0)
    counts = batches.fields["count"]
    for k, value in enumerate((0.1, 0.5, 1.0)):
        expected = np.full(batches.fields["energy"][:, k].shape, value, np.float32)
        check_lanes("energy", batches.fields["energy"][:, k], expected, counts)


@all_backends
@pytest.mark.parametrize("shiny", [False, True])
def test_combine(kernels, shiny):
    for seed in range(ROUNDS // 2):
        rng = np.random.default_rng(seed)
        batches = random_batches(rng)
        values = {name: hostile(rng, batches.fields[name].shape) for name in ("color", "energy")}
        values["shine"] = hostile(rng, batches.fields["shine"].shape)
        for name in values if shiny else ("color", "energy"):
            fill(batches, name, values[name])
        specular, emissive = hostile(rng, 3, finite=True), rng.random(3).astype(np.float32)
        for row in batches.rows:
            kernels.combine(row, specular if shiny else None, emissive)
        for k in range(3):
            expected = values["color"][:, k] * values["energy"][:, k]
            if shiny:
                expected = expected + specular[k] * values["shine"][:, k]
            expected = expected + emissive[k]
            got = batches.fields["color"][:, k]
            check_lanes(f"color[{k}]", got, expected, batches.fields["count"])
        check_poisoned(batches.fields, ["weight", "r", "position", "normal", "uv", "lod"])
        batches.check_gaps()
