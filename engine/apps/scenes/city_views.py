"""The benchmark city: its views, its lights, and frame timing.

In:  nothing but engine3d itself.
Out: scenes with as many lights as asked for, a walk along the same street in a city of any size, a
     view from above; CPU and wall-clock milliseconds per frame, the medians of several.
"""

import statistics
import time

import numpy as np

from ...base.linalg import look_at
from ...model.materials.linear_colors import linear
from ...model.scene.cameras import PerspectiveCamera
from ...model.scene.lights import WHITE_INTENSITY, DirectionalLight, PointLight
from ...model.scene.scene import Scene

#: The start of the walk: eye height over the pavement of the middle street, looking along it.
START, TARGET = (6.2, 1.85, 60.0), (0.0, 5.0, -60.0)
STEP = 0.06  # metres per frame: a walk at 60 frames per second
ABOVE, ABOVE_TARGET = (150.0, 320.0, 420.0), (-20.0, 0.0, -40.0)


def city_scene(world, lights=256, reach=17.0, moving=32):
    """Return a scene of a city at dusk, and the nodes of the moving lights.

    The first `moving` lights drive along the street, the others hang in the lamps that are nearest
    to the walk. With more lights than lamps the others float over the roofs.
    """
    scene = Scene((78, 96, 138), ambient=linear(0.11, 0.13, 0.20))
    world.add_to(scene)
    scene.add(
        DirectionalLight((-0.55, -0.55, -0.45), linear(0.62, 0.66, 0.92), 0.42 * WHITE_INTENSITY)
    )
    moving = min(moving, lights // 4)
    offsets = world.lamps - np.array(START)
    lamps = world.lamps[np.argsort((offsets * offsets).sum(axis=1), kind="stable")]
    floating = lamps + np.array((0.0, 10.0, 0.0))
    places = np.concatenate([lamps, floating, floating + np.array((0.0, 10.0, 0.0))])
    settings = {"color": linear(1.0, 0.74, 0.42), "intensity": 1.5 * WHITE_INTENSITY}
    if np.isfinite(reach):
        settings.update(range=reach, falloff="window")
    for place in places[: lights - moving]:
        scene.add(PointLight(**settings), translation=place)
    cars = [scene.add(PointLight(**settings)) for _ in range(moving)]
    drive(cars, 0)
    return scene, cars


def drive(cars, frame):
    """Move the lights to their places in a frame."""
    for number, node in enumerate(cars):
        along = (number * 9.7 + 0.25 * frame) % 120.0 - 60.0
        node.translation = (2.4 if number % 2 else -2.4, 1.0, along)


def street_camera(frame):
    """Return the street-level camera, one step farther each frame."""
    eye = (START[0], START[1], START[2] - STEP * frame)
    camera = PerspectiveCamera(yfov=1.0, znear=0.1, zfar=4000.0)
    return camera, look_at(eye, TARGET)


def above_camera(frame):
    """Return the camera above, slightly farther each frame."""
    eye = (ABOVE[0] - STEP * frame, ABOVE[1], ABOVE[2])
    camera = PerspectiveCamera(yfov=0.9, znear=5.0, zfar=6000.0)
    return camera, look_at(eye, ABOVE_TARGET)


def time_frames(renderer, scene, camera, frames, before=lambda frame: None, **options):
    """Draw frames after an uncounted first one; return a row of figures.

    Parameters
    ----------
    camera : callable
        From the frame's number to what `Renderer.render` takes.
    before : callable
        Called with the frame's number; its time counts.
    """
    renderer.render(scene, camera(0), **options)
    cpu, wall = [], []
    for frame in range(1, frames + 1):
        start = time.process_time(), time.perf_counter()
        before(frame)
        stats = renderer.render(scene, camera(frame), **options).stats
        cpu.append(1e3 * (time.process_time() - start[0]))
        wall.append(1e3 * (time.perf_counter() - start[1]))
    kept = ("triangles", "triangles_setup", "clusters_culled", "clusters_occluded")
    return {
        "cpu_milliseconds": statistics.median(cpu),
        "milliseconds": statistics.median(wall),
        **{name: stats[name] for name in kept if name in stats},
    }
