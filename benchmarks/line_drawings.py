"""Line drawings beside Open CASCADE's: milliseconds a view of the same parts.

In:  the ten parts of tests/drawings/, modelled and tessellated with cadquery-ocp.
Out: a table, or with --json one object: what was run where, and a row a part and view.

Of Open CASCADE, `exact` is `HLRBRep_Algo`, which draws the surfaces: `Add`, `Projector`, `Update`,
`Hide` and the lines as shapes, as CadQuery's export to SVG. `update` and `extract` are
`HLRBRep_PolyAlgo`, which draws the same triangles as engine3d: `Load`, `Projector` and `Update`,
and the lines as shapes. Of engine3d, `first` is the drawing of a new mesh, `view` another drawing
of a scene that was drawn before. All is processor time of one thread, the least of the repetitions,
which take turns.
"""

import argparse
import json
import platform
import sys
import time
from pathlib import Path

import numpy as np

import engine3d as e3d

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests"))
from drawings import occt_parts as occt
from OCP.HLRBRep import (
    HLRBRep_Algo,
    HLRBRep_HLRToShape,
    HLRBRep_PolyAlgo,
    HLRBRep_PolyHLRToShape,
)

#: Of the tessellation, in millimetres.
DEFLECTION = 0.05
#: The columns of times.
NAMES = "exact_ms", "update_ms", "extract_ms", "first_ms", "view_ms"
#: Of exact drawings that take seconds together.
MOST_EXACT = 3


def draw(thing, view):
    """Return the seconds that a drawing takes, with hidden lines and without intersections."""
    camera = occt.camera(view)
    start = time.process_time()
    e3d.drawings.line_drawing(
        thing, camera, size=(1000, 1000), scale=1.0, intersections=False, threads=1
    )
    return time.process_time() - start


def extract(lines):
    for kind in ("VCompound", "OutLineVCompound", "HCompound", "OutLineHCompound"):
        getattr(lines, kind)()


def draw_exactly(shape, view):
    """Return the seconds that the exact algorithm takes."""
    projector = occt.projector(view)
    start = time.process_time()
    algorithm = HLRBRep_Algo()
    algorithm.Add(shape)
    algorithm.Projector(projector)
    algorithm.Update()
    algorithm.Hide()
    extract(HLRBRep_HLRToShape(algorithm))
    return time.process_time() - start


def draw_triangles(shape, view):
    """Return the seconds until PolyAlgo has found the lines, and until they are shapes."""
    projector = occt.projector(view)
    start = time.process_time()
    algorithm = HLRBRep_PolyAlgo()
    algorithm.Load(shape)
    algorithm.Projector(projector)
    algorithm.Update()
    found = time.process_time()
    lines = HLRBRep_PolyHLRToShape()
    lines.Update(algorithm)
    extract(lines)
    return found - start, time.process_time() - found


def measure(parts, repeats):
    """Yield one row a part and view: milliseconds of each."""
    for part in parts:
        shape = part()
        positions, faces = occt.tessellate(shape, DEFLECTION)
        for view in occt.VIEWS:
            times = []
            exact = min(draw_exactly(shape, view) for _ in range(min(repeats, MOST_EXACT)))
            for _ in range(repeats):
                mesh, scene = e3d.Mesh(positions, faces), e3d.Scene()
                first = draw(mesh, view)
                scene.add(mesh)
                draw(scene, view)
                again = min(draw(scene, view) for _ in range(3))
                times.append((exact, *draw_triangles(shape, view), first, again))
            least = 1e3 * np.array(times).min(axis=0)
            row = dict(zip(NAMES, least.tolist(), strict=True))
            yield {"part": part.__name__, "view": view, "triangles": len(faces), **row}


def print_table(rows):
    print("                               Open CASCADE               engine3d         exact, times")
    print("part      view  triangles   exact  update extract   first    view   first    view")
    found = []
    for row in rows:
        times = [row[name] for name in NAMES]
        exact, _, _, first, view = times
        found.append(times)
        cells = "".join(f"{figure:8.2f}" for figure in (*times, exact / first, exact / view))
        print(f"{row['part']:<9} {row['view']:<6} {row['triangles']:>8}{cells}", flush=True)
    exact, update, extracted, first, view = np.array(found).T
    print("\nTimes as fast as Open CASCADE (geometric means)      first     view")
    several = {
        "HLRBRep_Algo": exact,
        "HLRBRep_PolyAlgo, update": update,
        "HLRBRep_PolyAlgo, update and extraction": update + extracted,
    }
    for name, times in several.items():
        by_first, by_view = (np.exp(np.log(times / own).mean()) for own in (first, view))
        print(f"{name:<48}{by_first:9.2f}{by_view:9.2f}")
    by_first, by_view = np.median(exact / first), np.median(exact / view)
    print(f"{'HLRBRep_Algo, median':<48}{by_first:9.2f}{by_view:9.2f}")


def main():
    parser = argparse.ArgumentParser(description="Compare line drawings with Open CASCADE's.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--repeats", type=int, default=9, help="repetitions (default: 9)")
    parser.add_argument("--part", action="append", help="only this part; may be repeated")
    arguments = parser.parse_args()
    parts = [one for one in occt.PARTS if not arguments.part or one.__name__ in arguments.part]
    rows = measure(parts, max(arguments.repeats, 1))
    if not arguments.json:
        print_table(rows)
        return
    machine = {"machine": platform.machine(), "python": platform.python_version()}
    json.dump({"engine3d": e3d.__version__, **machine, "rows": list(rows)}, sys.stdout)
    print()


if __name__ == "__main__":
    main()
