"""Writes docs/plan.md: the conditions by which a frame chooses how its tiles are drawn.

    python docs/make_plan.py            write it
    python docs/make_plan.py --check    exit with 1 if it is out of date

In: the table of csrc/frame/pass/plan.c, as built, and the plans of frames that are drawn here.
Out: one Markdown page, the same on every machine. A test keeps it up to date.
"""

from __future__ import annotations

import sys
from pathlib import Path

from generated_page import write_or_check

import engine3d as e3d
from engine3d._native.kernels_testing import asked_items, plan_conditions, planned_items

PAGE = Path(__file__).resolve().parent / "plan.md"
INTRODUCTION = """\
# The plan of a frame

Made from the table in `csrc/frame/pass/plan.c` by `docs/make_plan.py`. The core decides once per
frame, from what is asked for, what is done about it. Stages look the decision up and decide nothing
of the kind themselves. `frame.stats["plan"]` names it.
"""
#: What is drawn -> the arguments of `Renderer.render`.
EXAMPLES = {
    "a picture": {},
    "a picture without light": {"mode": "unlit"},
    "a metric depth picture": {"outputs": ("depth",)},
    "depths alone": {"outputs": ("ndc_depth",)},
    "a picture with IDs": {"outputs": ("color", "object_id")},
    "forward shading": {"shading": "forward"},
    "painter's algorithm": {"hidden_surfaces": "painter"},
    "overdraw": {"mode": "overdraw"},
    "a wireframe over the faces": {"wireframe": "overlay"},
    "a wireframe alone": {"wireframe": "only"},
    "no culling of what is hidden": {"culling": "frustum"},
}


def table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = [head, tuple("---" for _ in head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines) + "\n"


def names(items: list[str], between: str) -> str:
    return between.join(f"`{name.lower()}`" for name in items)


def condition(needs: list[str], forbids: list[str]) -> str:
    where = names(needs, " and ") or "always"
    return f"{where}, unless {names(forbids, ' or ')}" if forbids else where


def conditions_of_items() -> dict[str, str]:
    """Where each planned item holds: its conditions, as one sentence."""
    found: dict[str, list[str]] = {}
    for item, needs, forbids in plan_conditions():
        found.setdefault(item, []).append(condition(needs, forbids))
    return {item: "; or ".join(conditions) for item, conditions in found.items()}


def example_rows() -> list[tuple[str, ...]]:
    scene = e3d.Scene()
    scene.add(e3d.box())
    scene.add(e3d.DirectionalLight())
    camera = e3d.frame_scene(scene)
    renderer = e3d.Renderer((32, 32), look="plain", samples=1)
    rows = []
    for title, options in EXAMPLES.items():
        plan = renderer.render(scene, camera, **options).stats["plan"]
        rows.append((title, names(list(plan), ", ")))
    return rows


def page() -> str:
    where = conditions_of_items()
    asked = [(f"`{name.lower()}`", text) for name, text in asked_items()]
    planned = [(f"`{name.lower()}`", text, where[name]) for name, text in planned_items()]
    return "\n".join(
        [
            INTRODUCTION,
            "## What a frame may ask for\n",
            table(("Name", "The frame asks for"), asked),
            "## What is done about it\n",
            "An item holds where one of its conditions does. They are tried in this order, so\n"
            "that a condition may name items above it.\n",
            table(("Name", "What it means", "Where"), planned),
            "## Some plans\n",
            "Of a lit box with one light, drawn with these options.\n",
            table(("What is drawn", '`frame.stats["plan"]`'), example_rows()),
        ]
    )


def main(arguments: list[str]) -> int:
    return write_or_check(PAGE, page(), arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
