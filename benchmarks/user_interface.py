"""What a frame of a user interface costs: Dear ImGui's demo over docked panels, at 1920 x 1080.

In:  the installed engine3d, and imgui-bundle (``pip install engine3d[editor]``).
Out: a table, or with --json one object: milliseconds of each backend, one thread, beside the aim.

The panels are two long lists of texts and buttons, and a picture of 1,100 x 700 pixels as a scene
would be shown. Laying out, which ImGui does itself, is not measured. The fastest of the repetitions
counts.
"""

import argparse
import json
import platform
import sys
import time

import numpy as np
from imgui_bundle import imgui

import engine3d
from engine3d.apps.imgui_painter.imgui_painter import ImguiPainter

WIDTH, HEIGHT = 1920, 1080
PICTURE = 1100, 700
AIM_MILLISECONDS = 1.5


def dock(space):
    """Lay out two lists at the sides, the picture between them."""
    inner = imgui.internal
    inner.dock_builder_set_node_size(space, (WIDTH, HEIGHT))
    *_, right, rest = inner.dock_builder_split_node_py(space, imgui.Dir.right, 0.25)
    *_, left, middle = inner.dock_builder_split_node_py(rest, imgui.Dir.left, 0.2)
    for name, place in {"left": left, "right": right, "picture": middle}.items():
        inner.dock_builder_dock_window(name, place)
    inner.dock_builder_finish(space)


def lay_out(number, is_first):
    imgui.get_io().delta_time = 1 / 60
    imgui.new_frame()
    space = imgui.dock_space_over_viewport()
    if is_first:
        dock(space)
    for name in ("left", "right"):
        imgui.begin(name)
        for k in range(60):
            imgui.text(f"line {k} of the list on the {name}")
            imgui.same_line()
            imgui.button(f"press##{k}")
        imgui.end()
    imgui.begin("picture")
    imgui.image(imgui.ImTextureRef(number), PICTURE)
    imgui.end()
    imgui.show_demo_window()
    imgui.render()
    return imgui.get_draw_data()


def draw_data(painter):
    """A frame that has settled, with its textures made."""
    io = imgui.get_io()
    io.config_flags |= imgui.ConfigFlags_.docking_enable
    io.set_ini_filename("")
    io.display_size = imgui.ImVec2(WIDTH, HEIGHT)
    picture = np.random.default_rng(0).integers(0, 256, (*PICTURE[::-1], 4), np.uint8)
    number = painter.add(picture, opaque=True)
    pixels = np.zeros((HEIGHT, WIDTH, 4), np.uint8)
    for k in range(4):
        drawn = lay_out(number, k == 0)
        painter.draw(drawn, pixels)
    return drawn


def measure(backend, repeats):
    context = imgui.create_context()
    painter = ImguiPainter(backend)
    drawn = draw_data(painter)
    pixels = np.zeros((HEIGHT, WIDTH, 4), np.uint8)
    best = float("inf")
    for _ in range(repeats):
        start = time.perf_counter()
        painter.draw(drawn, pixels)
        best = min(best, time.perf_counter() - start)
    triangles = drawn.total_idx_count // 3
    imgui.destroy_context(context)
    return {"backend": backend, "triangles": triangles, "milliseconds": 1e3 * best}


def main():
    parser = argparse.ArgumentParser(description="Measure a frame of a user interface.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--repeats", type=int, default=300, help="repetitions (default: 300)")
    arguments = parser.parse_args()
    rows = []
    for backend in engine3d.backends():
        slow = backend in ("scalar", "portable")
        repeats = max(arguments.repeats // (100 if slow else 1), 1)
        rows.append(measure(backend, repeats))
        if not arguments.json:
            print("{backend:>9}: {milliseconds:8.2f} ms, {triangles} triangles".format(**rows[-1]))
    if not arguments.json:
        print(f"the aim is {AIM_MILLISECONDS:g} ms on one thread, by the fastest backend")
        return
    machine = {"machine": platform.machine(), "python": platform.python_version()}
    json.dump({"engine3d": engine3d.__version__, **machine, "rows": rows}, sys.stdout)
    print()


if __name__ == "__main__":
    main()
