"""How fast model files load: megabytes a second, beside trimesh and tinyobjloader in one run.

In:  the installed engine3d; files of --megabytes that are made here, in a temporary folder, or the
     files named. PLY and STL are binary and text.
Out: a table, or with --json one object: what was run where, and a row a file and loader.

The surface is a wavy tube of triangles, with or without texture coordinates and normals. Every
loader has a process of its own for each file, which loads a small one first, so that imports count
for nothing; processor time counts, of all threads, the fastest of the repetitions. "NumPy" only
reads the bytes of a binary file and copies positions and corners (for STL: the corners, not
welded). A package that is not installed is named as missing.
"""

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import engine3d

# What a load does, as the body of `load(path)`.
LOADERS = {
    "engine3d": "import engine3d\ndef load(path): return engine3d.load_mesh(path)",
    "trimesh": "import trimesh\ndef load(path): return trimesh.load(path, process=False)",
    "tinyobjloader": """import tinyobjloader
def load(path):
    reader = tinyobjloader.ObjReader()
    assert reader.ParseFromFile(path), reader.Error()
    shapes = [shape.mesh.numpy_indices() for shape in reader.GetShapes()]
    return reader.GetAttrib().numpy_vertices(), shapes""",
    "NumPy": """import numpy as np
def load(path):
    data = open(path, "rb").read()
    if path.endswith(".stl"):
        count = int.from_bytes(data[80:84], "little")
        facets = np.frombuffer(data, [("n", "<f4", 3), ("c", "<f4", 9), ("a", "<u2")], count, 84)
        return np.ascontiguousarray(facets["c"])
    start = data.index(b"end_header\\n") + 11
    counts = [int(line.split()[-1]) for line in data[:start].split(b"\\n") if b"element" in line]
    width = data[:start].count(b"property float")
    points = np.frombuffer(data, ("<f4", width), counts[0], start)
    faces = np.frombuffer(data, [("n", "u1"), ("c", "<i4", 3)], counts[1], start + points.nbytes)
    return points[:, :3].copy(), np.ascontiguousarray(faces["c"])""",
}
CHILD = """
import json, sys, time, warnings
warnings.simplefilter("ignore")
def peak():
    lines = open("/proc/self/status").read().splitlines()
    return 1024 * int(next(line for line in lines if line.startswith("VmHWM")).split()[1])
small, path, repeat = sys.argv[1], sys.argv[2], int(sys.argv[3])
load(small)
open("/proc/self/clear_refs", "w").write("5")  # the peak begins anew
before, times, grown = peak(), [], None
for _ in range(repeat):
    wall, start = time.perf_counter(), time.process_time()
    kept = load(path)
    times.append((time.process_time() - start, time.perf_counter() - wall))
    grown = grown or peak() - before
    del kept
print(json.dumps([*map(min, zip(*times)), grown]))
"""
READS = {
    ".obj": ("engine3d", "trimesh", "tinyobjloader"),
    ".ply": ("engine3d", "trimesh", "NumPy"),
    ".stl": ("engine3d", "trimesh", "NumPy"),
    ".off": ("engine3d", "trimesh"),
    ".asc": ("engine3d",),
}


def write_tube(path, megabytes, full):
    """Write an OBJ file of about this size; with texture coordinates and normals if `full`."""
    side = max(int((megabytes * 1e6 / (200 if full else 74)) ** 0.5), 3)
    angle = np.linspace(0, 2 * np.pi, side, endpoint=False)
    with open(path, "w") as file:
        file.write("# a wavy tube\n")
        for row in range(side):
            radius = 1 + 0.1 * np.sin(5 * angle + 9 * row / side)
            columns = radius * np.cos(angle), radius * np.sin(angle)
            points = zip(columns[0].tolist(), [row / side] * side, columns[1].tolist(), strict=True)
            file.write("".join(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points))
        for row in range(side if full else 0):
            file.write("".join(f"vt {k / side:.6f} {row / side:.6f}\n" for k in range(side)))
            normals = zip(np.cos(angle).tolist(), np.sin(angle).tolist(), strict=True)
            file.write("".join(f"vn {x:.4f} 0.0000 {z:.4f}\n" for x, z in normals))
        corner = "{0}/{0}/{0}" if full else "{0}"
        for row in range(side - 1):
            for k in range(side):
                low = [row * side + 1 + column for column in (k, (k + 1) % side)]
                a, b, c, d = (corner.format(n) for n in (*low, low[1] + side, low[0] + side))
                file.write(f"f {a} {b} {c}\nf {a} {c} {d}\n")


def write_off(path, mesh):
    points, faces = mesh.positions.tolist(), mesh.faces.tolist()
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        file.write("".join(f"{x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points))
        file.write("".join(f"3 {a} {b} {c}\n" for a, b, c in faces))


def write_asc(path, mesh):
    """Write a 3D Studio file, with a material and a smoothing group for each face."""
    points, faces = mesh.positions.tolist(), mesh.faces.tolist()
    with open(path, "w") as file:
        file.write(
            f'Named object: "a"\nTri-mesh, Vertices: {len(points)}     Faces: {len(faces)}\n'
        )
        for k, (x, y, z) in enumerate(points):
            file.write(f"Vertex {k}:  X:{x:.6f}     Y:{y:.6f}     Z:{z:.6f}\n")
        for k, (a, b, c) in enumerate(faces):
            file.write(f"Face {k}:    A:{a} B:{b} C:{c} AB:1 BC:1 CA:1\n")
            file.write('Material:"r255g128b0a0"\nSmoothing: 1\n')


def made_files(folder, sizes):
    """The files to load: OBJ of each size, plain and full; the other formats of the smallest."""
    files = []
    for size in sizes:
        for full in (False, True):
            path = Path(folder) / f"{'full' if full else 'plain'}-{size:g}.obj"
            write_tube(path, size, full)
            files.append(path)
    mesh = engine3d.load_mesh(files[0])
    for extension in (".ply", ".stl"):
        path = files[0].with_suffix(extension)
        text = path.with_stem(path.stem + "-text")
        mesh.save(path)
        mesh.save(text, ascii=True)
        files += [path, text]
    for extension, write in ((".off", write_off), (".asc", write_asc)):
        files.append(files[0].with_suffix(extension))
        write(files[-1], mesh)
    return files


def loaders_of(path):
    """Who reads a file: NumPy has none for text."""
    with open(path, "rb") as file:
        head = file.read(80)
    is_text = head.startswith((b"ply\nformat ascii", b"solid"))
    return [name for name in READS[path.suffix.lower()] if not (is_text and name == "NumPy")]


def measure(loader, small, path, repeat):
    """Seconds of processor and clock, and bytes of memory; None where the package is missing."""
    command = [sys.executable, "-c", LOADERS[loader] + CHILD, str(small), str(path), str(repeat)]
    child = subprocess.run(command, capture_output=True, text=True)
    if "ModuleNotFoundError" in child.stderr:
        return None
    if child.returncode:
        raise SystemExit(f"{loader} cannot load {path}:\n{child.stderr}")
    return json.loads(child.stdout.splitlines()[-1])


def row_of(loader, folder, path, repeat):
    size = os.path.getsize(path)
    small = Path(folder) / f"small{path.suffix.lower()}"
    if not small.exists():
        mesh = engine3d.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        write = {".off": write_off, ".asc": write_asc}.get(small.suffix)
        write(small, mesh) if write else mesh.save(small)
    row = {"file": path.name, "megabytes": size / 1e6, "loader": loader}
    measured = measure(loader, small, path, repeat)
    if measured is None:
        return {**row, "missing": True}
    seconds, clock, memory = measured
    return {
        **row,
        "milliseconds": 1e3 * seconds,
        "clock_milliseconds": 1e3 * clock,
        "megabytes_a_second": size / 1e6 / seconds,
        "memory_over_size": memory / size,
    }


def line_of(row):
    start = f"{row['file']:24}{row['megabytes']:9.1f}  {row['loader']:14}"
    if "missing" in row:
        return f"{start}  missing: not installed"
    return start + (
        f"{row['milliseconds']:10.1f}{row['megabytes_a_second']:10.0f}"
        f"{row['memory_over_size']:10.1f}"
    )


def main():
    parser = argparse.ArgumentParser(description="Measure how fast model files load.")
    parser.add_argument(
        "files", nargs="*", type=Path, help="OBJ, PLY, STL, OFF or ASC; made if left out"
    )
    parser.add_argument("--megabytes", type=float, nargs="+", default=[20.0])
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--only", nargs="+", choices=LOADERS, default=list(LOADERS))
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    report = {
        "version": engine3d.__version__,
        "python": platform.python_version(),
        "machine": platform.machine(),
        "rows": [],
    }
    if not arguments.json:
        print(f"engine3d {report['version']}, Python {report['python']}, {report['machine']}")
        print(f"{'file':24}{'MB':>9}  {'loader':14}{'ms':>10}{'MB/s':>10}{'memory':>10}")
    with tempfile.TemporaryDirectory() as folder:
        for path in arguments.files or made_files(folder, arguments.megabytes):
            for loader in loaders_of(path):
                if loader not in arguments.only:
                    continue
                report["rows"].append(row_of(loader, folder, path, arguments.repeat))
                if not arguments.json:
                    print(line_of(report["rows"][-1]), flush=True)
    if arguments.json:
        print(json.dumps(report, indent=2))
    else:
        print("ms: processor time of all threads; memory: growth of the peak over the file's size")


if __name__ == "__main__":
    main()
