"""Parts that are sheets' models in many tests, small sheets of them, and how a file is written."""

import numpy as np
import pytest

import engine3d as e3d

SIZE = (480, 360)


def part():
    """A base with a ball on it and a post behind; a small box inside of the base."""
    scene = e3d.Scene(background=(1, 2, 3), ambient=e3d.linear(0.5, 0.4, 0.3))
    for name, mesh, place, color in (
        ("base", e3d.box((4, 1, 2)), (0, 0.5, 0), (90, 140, 200)),
        ("ball", e3d.uv_sphere(0.7, (24, 12)), (0.8, 1.7, 0.3), (220, 90, 60)),
        ("inside", e3d.box((0.3, 0.3, 0.3)), (0, 0.5, 0), (80, 180, 90)),
        ("post", e3d.box((0.5, 1.0, 0.5)), (0.8, 1.5, -0.7), (200, 200, 60)),
    ):
        mesh.materials = [e3d.Material(color=color, name=f"paint of {name}")]
        scene.add(mesh, name=name, translation=place)
    return scene


def drawn(models, size=SIZE, **options):
    return e3d.sheets.contact_sheet(models, size=size, threads=1, **options)


def views_of(sheet, model=0):
    return {view["name"]: view for view in sheet.report["models"][model]["views"]}


def of_mesh(positions, faces, **options):
    scene = e3d.Scene()
    scene.add(e3d.Mesh(positions, faces, **options))
    return scene


def triangle(**options):
    return of_mesh(np.eye(3), [[0, 1, 2]], **options)


@pytest.fixture(scope="session")
def part_sheet():
    return drawn(part(), views="front,right,top,iso,turned=30,20,below=0.2,1,0.1")
