"""Forward against deferred shading over the number of lights, in a street of the city.

In:  the installed engine3d.
Out: a table, or with --json one object: CPU milliseconds a frame for each number of lights; with
     --plot a chart as SVG or as an image.

Lights have a range, as street lamps do, or with --range inf shine everywhere. Both ways of shading
give the same bytes, which is checked.
"""

import argparse
import json
import math
import platform
import sys

import bar_chart

import engine3d as e3d
from engine3d.apps.scenes.city_views import city_scene, drive, street_camera, time_frames

COUNTS = tuple(2**power for power in range(11))
SHADINGS = ("forward", "deferred")


def measure(arguments):
    """Yield a row for each number of lights."""
    world = e3d.worlds.city(arguments.triangles)
    width, height = arguments.size
    with e3d.Renderer(
        (width, height), threads=arguments.threads, look="plain", samples=1
    ) as renderer:
        for count in COUNTS:
            if count > arguments.most:
                break
            scene, cars = city_scene(world, count, arguments.range)
            frames = {
                s: renderer.render(scene, street_camera(0), shading=s, cull="back")
                for s in SHADINGS
            }
            row = {"lights": count}
            row["same_bytes"] = bool((frames["forward"].color == frames["deferred"].color).all())
            for shading in SHADINGS:
                figures = time_frames(
                    renderer,
                    scene,
                    street_camera,
                    arguments.frames,
                    lambda frame, cars=cars: drive(cars, frame),
                    shading=shading,
                )
                row[shading] = figures["cpu_milliseconds"]
            row["forward_over_deferred"] = row["forward"] / row["deferred"]
            yield row


def print_table(rows):
    print(f"{'lights':>6} {'forward ms':>11} {'deferred ms':>12} {'forward / deferred':>19}")
    for row in rows:
        note = "" if row["same_bytes"] else "  the bytes differ"
        print(
            f"{row['lights']:>6} {row['forward']:>11.1f} {row['deferred']:>12.1f} "
            f"{row['forward_over_deferred']:>19.2f}{note}",
            flush=True,
        )
        yield row


def picture_size(text):
    width, height = text.lower().split("x")
    return int(width), int(height)


def main():
    parser = argparse.ArgumentParser(description="Compare forward with deferred shading.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--plot", metavar="FILE", help="a chart: .svg, or an image")
    parser.add_argument("--triangles", type=int, default=1_000_000, help="of the city")
    parser.add_argument("--range", type=float, default=17.0, help="of a light; inf: no end")
    parser.add_argument("--most", type=int, default=COUNTS[-1], help="lights, at most")
    parser.add_argument("--frames", type=int, default=10, help="frames a figure (default: 10)")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--size", type=picture_size, default=(1280, 720), metavar="WxH")
    arguments = parser.parse_args()
    rows = measure(arguments)
    rows = list(rows if arguments.json else print_table(rows))
    if arguments.plot:
        shown = [(f"{row['lights']} lights", [row[s] for s in SHADINGS]) for row in rows]
        title = "CPU milliseconds a frame, city, street level"
        bar_chart.save(arguments.plot, title, shown, SHADINGS)
    if arguments.json:
        machine = {"machine": platform.machine(), "python": platform.python_version()}
        reach = arguments.range if math.isfinite(arguments.range) else "inf"
        settings = {"threads": arguments.threads, "range": reach}
        json.dump({"engine3d": e3d.__version__, **machine, **settings, "rows": rows}, sys.stdout)
        print()


if __name__ == "__main__":
    main()
