"""What shadows cost, hard and soft, of maps and exact, and with samples shaded alone: workload W15.

In:  the installed engine3d.
Out: a table, or with --json one object: milliseconds of a frame on one thread, for each scene,
light and kind of shadow; maps and trees are kept from the frames before.

A frame has 640 x 480 pixels of 4 samples. The scenes are a ball and a post on a plane, and a fence.
The fastest of the repetitions counts, kind after kind in turns.
"""

import argparse
import json
import platform

import engine3d as e3d

SIZE = 640, 480
SUN, LAMP = 0.05, 0.15  # radians; world units
KINDS = {
    "none": ({"shadow": "none"}, {}),
    "map": ({"shadow": "map"}, {}),
    "map, soft": ({"shadow": "map"}, {}),
    "exact": ({"shadow": "exact"}, {}),
    "exact, samples alone": ({"shadow": "exact"}, {"sample_shading": True}),
    "exact, soft": ({"shadow": "exact"}, {}),
}


def ball(scene):
    scene.add(e3d.primitives.icosphere(0.7, 4), translation=(0, 0.7, 0))
    scene.add(e3d.primitives.box((0.3, 1.6, 0.3)), translation=(1.3, 0.8, -0.8))


def fence(scene):
    slat = e3d.primitives.box((0.18, 1.4, 0.05))
    for k in range(15):
        scene.add(slat, translation=(0.3 * k - 2.1, 0.7, 0))
    scene.add(e3d.primitives.box((4.6, 0.1, 0.05)), translation=(0, 1.1, -0.05))


SCENES = {"ball": ball, "fence": fence}


def scene_of(name, light, kind):
    """A scene under one light, on a plane."""
    scene = e3d.Scene(background=(40, 60, 90), ambient=e3d.linear(0.1, 0.1, 0.1))
    scene.add(e3d.primitives.plane(12.0))
    SCENES[name](scene)
    shadow, soft = KINDS[kind][0], "soft" in kind
    if light == "sun":
        size = SUN if soft else 0.0
        scene.add(e3d.DirectionalLight((-0.6, -1, 0.5), shadow_softness=size, **shadow))
    else:
        size = LAMP if soft else 0.0
        spot = e3d.SpotLight(intensity=90.0, outer_cone_angle=0.9, shadow_softness=size, **shadow)
        scene.add(spot, pose=e3d.look_at((2.5, 4.5, -2), (0, 0, 0)))
    scene.add(e3d.PerspectiveCamera(yfov=0.8), pose=e3d.look_at((1.5, 2.6, 4.5), (0, 0.4, -0.6)))
    return scene


def measure(name, light, repeats):
    """Return the least milliseconds of each kind of shadow."""
    scenes = {kind: scene_of(name, light, kind) for kind in KINDS}
    renderers = {
        kind: e3d.Renderer(SIZE, samples=4, antialiasing="msaa", threads=1) for kind in KINDS
    }
    least = dict.fromkeys(KINDS, float("inf"))
    for _ in range(repeats + 1):
        for kind, scene in scenes.items():
            stats = renderers[kind].render(scene, **KINDS[kind][1]).stats
            least[kind] = min(least[kind], stats["ms_total"])
    return least


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=20)
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args()
    rows = [
        {"scene": name, "light": light, "milliseconds": measure(name, light, given.repeats)}
        for name in SCENES
        for light in ("sun", "spot")
    ]
    if given.json:
        machine, version = platform.processor() or platform.machine(), e3d.__version__
        print(json.dumps({"engine3d": version, "machine": machine, "size": SIZE, "rows": rows}))
        return
    print(f"{'':12}" + "".join(f"{kind:>22}" for kind in KINDS))
    for row in rows:
        values = "".join(f"{value:22.1f}" for value in row["milliseconds"].values())
        print(f"{row['scene']:6}{row['light']:6}" + values)


if __name__ == "__main__":
    main()
