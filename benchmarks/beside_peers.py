"""What other renderers for Python take for the same jobs, each alone in a process of its own.

In:  the installed engine3d; --peers, a Python that has some of f3d, PyVista, Open3D, pyrender (with
     trimesh) and Blender (bpy), by default this one. They draw with Mesa where there is no GPU.
Out: a table in Markdown, or with --json one object: a row a library.

The jobs: import the library; draw a small model, 640 x 480, into a PNG file, import included; load
a binary PLY of --triangles (a wavy sphere, made here in a temporary folder); load it and draw it,
1280 x 720 with one sample; draw it again from a camera that goes round it, until the picture is an
array, where the library gives one. Times are by the clock, the median of --repeat processes, or of
a process's pictures after the second; memory is the peak of the process that draws the pictures.
The size is that of the files of a library and of all that it requires.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import engine3d as e3d

LIBRARIES = ("engine3d", "f3d", "pyvista", "open3d", "pyrender", "bpy")
IMPORTS = {name: f"import {name}" for name in LIBRARIES} | {
    "pyrender": """
import os
os.environ["PYOPENGL_PLATFORM"] = "egl"
import numpy as np
np.infty = np.inf
import trimesh, pyrender"""
}
# What the small model and the large one have in common: a function that draws `path` from three
# units away, turned by `angle`, and returns the picture; `write(path)` draws the first one, once,
# and writes it.
DRAWING = {
    "engine3d": """
def opened(path, size):
    scene = engine3d.Scene()
    scene.add(engine3d.load_mesh(path))
    scene.add(engine3d.DirectionalLight())
    renderer = engine3d.Renderer(size, samples=1)
    camera = engine3d.PerspectiveCamera(0.7, znear=0.1, zfar=10)
    frame = None
    def draw(angle):
        nonlocal frame
        eye = 3 * math.sin(angle), 0.5, 3 * math.cos(angle)
        frame = renderer.render(scene, (camera, engine3d.look_at(eye, (0, 0, 0))), out=frame)
        return frame.color
    def write(path):
        draw(0.0)
        frame.save(path)
    return draw, write""",
    "f3d": """
def opened(path, size):
    engine = f3d.Engine.create(True)
    engine.window.size = size
    engine.scene.add(path)
    image, last = None, 0.0
    def draw(angle):
        nonlocal image, last
        engine.window.camera.azimuth(math.degrees(angle - last))
        image, last = engine.window.render_to_image(), angle
        return image
    return draw, lambda path: draw(0.0).save(path)""",
    "pyvista": """
def opened(path, size):
    plotter = pyvista.Plotter(off_screen=True, window_size=size)
    plotter.add_mesh(pyvista.read(path))
    last = None
    def draw(angle):
        nonlocal last
        if last is not None:  # the first screenshot renders, later ones don't
            plotter.camera.azimuth += math.degrees(angle - last)
            plotter.render()
        last = angle
        return plotter.screenshot(return_img=True)
    return draw, plotter.screenshot""",
    "open3d": """
def opened(path, size):
    mesh = open3d.io.read_triangle_mesh(path)
    mesh.compute_vertex_normals()
    renderer = open3d.visualization.rendering.OffscreenRenderer(*size)
    material = open3d.visualization.rendering.MaterialRecord()
    material.shader = "defaultLit"
    renderer.scene.add_geometry("mesh", mesh, material)
    def draw(angle):
        eye = [3 * math.sin(angle), 0.5, 3 * math.cos(angle)]
        renderer.setup_camera(40.0, [0, 0, 0], eye, [0, 1, 0])
        return numpy.asarray(renderer.render_to_image())
    return draw, lambda path: open3d.io.write_image(path, open3d.geometry.Image(draw(0.0)))""",
    "pyrender": """
def opened(path, size):
    scene = pyrender.Scene()
    scene.add(pyrender.Mesh.from_trimesh(trimesh.load(path, process=False, force="mesh")))
    camera = scene.add(pyrender.PerspectiveCamera(0.7))
    scene.add(pyrender.DirectionalLight(intensity=3))
    renderer = pyrender.OffscreenRenderer(*size)
    def draw(angle):
        sine, cosine = math.sin(angle), math.cos(angle)
        pose = [[cosine, 0, sine, 3 * sine], [0, 1, 0, 0], [-sine, 0, cosine, 3 * cosine]]
        scene.set_pose(camera, numpy.array([*pose, [0, 0, 0, 1]], float))
        return renderer.render(scene)[0]
    def write(path):
        from PIL import Image
        Image.fromarray(draw(0.0)).save(path)
    return draw, write""",
    "bpy": """
def opened(path, size):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    read = bpy.ops.wm.ply_import if path.endswith(".ply") else bpy.ops.wm.obj_import
    read(filepath=path)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera, scene.render.engine = camera, "BLENDER_WORKBENCH"
    scene.display.render_aa = "OFF"
    scene.render.resolution_x, scene.render.resolution_y = size
    def draw(angle, **options):
        camera.location = 3 * math.sin(angle), -3 * math.cos(angle), 0
        camera.rotation_euler = math.pi / 2, 0, angle
        bpy.ops.render.render(**options)  # its pixels are no array: they can only be had as a file
    def write(path):
        scene.render.filepath = path
        draw(0.0, write_still=True)
    return draw, write""",
}
LOADS = {
    "engine3d": "engine3d.load_mesh(path)",
    "pyvista": "pyvista.read(path)",
    "open3d": "open3d.io.read_triangle_mesh(path)",
    "pyrender": "trimesh.load(path, process=False)",
    "bpy": "bpy.ops.wm.read_factory_settings(use_empty=True); bpy.ops.wm.ply_import(filepath=path)",
}
JOBS = {
    "import": "",
    "first": "draw, write = opened(small, (640, 480)); write(written)",
    "load": "mark(); {load}; mark()",
    "pictures": """
mark(); draw, write = opened(large, (1280, 720)); picture = draw(0.0); mark()
for number in range(1, 10):
    mark(); picture = draw(0.1 * number); mark()""",
}
CHILD = """
import json, math, os, resource, sys, time, warnings
warnings.simplefilter("ignore")
import numpy
small, large, written = sys.argv[1:]
path, marks = large, []
def mark(): marks.append(time.perf_counter())
{importing}
{drawing}
{job}
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
print("@" + json.dumps([marks, peak]), flush=True)
os._exit(0)  # some libraries crash when Python ends
"""
SIZE = """
import importlib.metadata, json, re, sys
def files(name, seen):
    seen.add(name)
    try:
        found = importlib.metadata.distribution(name)
    except importlib.metadata.PackageNotFoundError:
        return
    for line in found.requires or ():
        needed = re.match(r"[\\w.-]+", line)[0].lower().replace("_", "-")
        if "extra ==" not in line and needed not in seen:
            yield from files(needed, seen)
    yield from (file.locate() for file in found.files or ())
name = sys.argv[1]
whole = sum(path.stat().st_size for path in {*files(name, set())} if path.is_file())
print("@" + json.dumps([importlib.metadata.version(name), whole]))
"""


def report(python, code, *arguments):
    """How long a process of a Python takes, and what it says as JSON; None where it fails."""
    start = time.perf_counter()
    command = [python, "-c", code, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    seconds = time.perf_counter() - start
    said = [line[1:] for line in done.stdout.splitlines() if line.startswith("@")]
    return (seconds, *json.loads(said[-1])) if said else None


def program(library, job):
    """What a process does for a job."""
    steps = JOBS[job].format(load=LOADS.get(library, ""))
    return CHILD.format(importing=IMPORTS[library], drawing=DRAWING[library], job=steps)


def figures(python, library, folder, repeat):
    """What one library takes: a row of the table; None for what it cannot do."""
    files = [folder / name for name in ("small.obj", "large.ply", f"{library}.png")]

    def tries(job, count):
        found = (report(python, program(library, job), *files) for _ in range(count))
        return [said for said in found if said]

    def median(values):
        return statistics.median(values) if values else None

    size = report(python, SIZE, library)
    if size is None:
        return None
    loads = tries("load", repeat) if library in LOADS else []
    pictures = tries("pictures", 1)
    marks = pictures[0][1] if pictures else []
    seconds = [end - start for start, end in zip(marks[::2], marks[1::2], strict=True)]
    return {
        "library": library,
        "version": size[1],
        "installed_bytes": size[2],
        "import_s": median([said[0] for said in tries("import", repeat)]),
        "first_picture_s": median([said[0] for said in tries("first", repeat)]),
        "load_s": median([marks[1] - marks[0] for _, marks, _ in loads]),
        "load_and_picture_s": seconds[0] if seconds else None,
        "picture_s": median(seconds[2:]),
        "memory_bytes": pictures[0][2] if pictures else None,
    }


def write_models(folder, triangles):
    """Write a small OBJ and a large binary PLY: spheres of radius 1, the large one wavy."""
    e3d.save_mesh(e3d.uv_sphere(1.0, (64, 32)), folder / "small.obj")
    rings = max(round((triangles / 4) ** 0.5), 2)
    sphere = e3d.uv_sphere(1.0, (2 * rings, rings))
    waves = 1 + 0.05 * np.sin(20 * sphere.positions).prod(axis=1, keepdims=True)
    e3d.save_mesh(e3d.Mesh(sphere.positions * waves, sphere.faces), folder / "large.ply")


COLUMNS = (
    ("installed_bytes", "installed, MB", 1e-6, ".0f"),
    ("import_s", "import, s", 1, ".2f"),
    ("first_picture_s", "first picture, s", 1, ".2f"),
    ("load_s", "load, s", 1, ".2f"),
    ("load_and_picture_s", "load and first picture, s", 1, ".1f"),
    ("picture_s", "each later picture, ms", 1000, ".0f"),
    ("memory_bytes", "memory, GB", 1e-9, ".1f"),
)


def table(rows):
    """The rows in Markdown."""
    yield "| | " + " | ".join(title for _, title, _, _ in COLUMNS) + " |"
    yield "|---|" + "---:|" * len(COLUMNS)
    for row in rows:
        cells = [
            "–" if row[key] is None else format(row[key] * scale, form)
            for key, _, scale, form in COLUMNS
        ]
        yield f"| {row['library']} {row['version']} | " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description="Measure other renderers at the same jobs.")
    parser.add_argument("--peers", default=sys.executable, help="a Python that has the others")
    parser.add_argument("--only", nargs="+", choices=LIBRARIES, default=LIBRARIES)
    parser.add_argument("--triangles", type=int, default=5_000_000)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as name:
        write_models(Path(name), args.triangles)
        for library in args.only:
            python = sys.executable if library == "engine3d" else args.peers
            row = figures(python, library, Path(name), args.repeat)
            if row is None:
                print(f"{library} is not installed there", file=sys.stderr)
            else:
                rows.append(row)
    print(json.dumps({"rows": rows}) if args.json else "\n".join(table(rows)))


if __name__ == "__main__":
    main()
