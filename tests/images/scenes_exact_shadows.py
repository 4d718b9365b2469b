"""Exact shadows of all lights, on all kinds of surface, of shards, and of what has holes."""

import numpy as np
from images.objects import CORAL, TEAL, camera_at, floor, with_material
from images.picture import Picture, variant
from images.scenes_alpha import leaf, pane

import engine3d as e3d

SUN_WAY = (-0.5, -0.8, -0.35)
SUN = e3d.DirectionalLight(SUN_WAY, intensity=0.8 * np.pi, shadow="exact")


def lamp(scene, kind, **options):
    """One light of a kind that casts exact shadows."""
    if kind == "point":
        light = e3d.PointLight(
            e3d.linear(1, 0.9, 0.7), intensity=1.2 * np.pi, shadow="exact", **options
        )
        scene.add(light, translation=(0.5, 1.6, 0.8))
    elif kind == "spot":
        light = e3d.SpotLight(
            e3d.linear(0.8, 0.9, 1), intensity=8 * np.pi, shadow="exact", **options
        )
        scene.add(light, pose=e3d.look_at((-1.5, 2.4, 1.8), (0, 0.2, 0)))
    else:
        scene.add(SUN)


def table(kinds, samples=1, physical=False, **options):
    """Things on a floor, and what no shadow falls on, what casts none, and what is not in view."""
    scene = e3d.Scene(background=(20, 24, 34), ambient=e3d.linear(0.08, 0.08, 0.1))
    surface = (
        {"metallic": 0.2, "roughness": 0.5} if physical else {"specular": e3d.linear(0.4, 0.4, 0.4)}
    )
    scene.add(floor(4.0, color=e3d.linear(0.7, 0.7, 0.7), **surface))
    scene.add(
        with_material(e3d.box(0.5), color=CORAL, **surface),
        translation=(-0.3, 0.25, 0.1),
        euler=(0, 0.5, 0),
    )
    scene.add(with_material(e3d.uv_sphere(0.3), color=TEAL), translation=(0.5, 0.3, 0.3))
    ring = with_material(e3d.torus(), color=e3d.linear(0.3, 0.8, 0.4), **surface)
    scene.add(ring, translation=(0.1, 0.8, -0.4), euler=(1.1, 0.3, 0), scale=(0.4, 0.4, 0.4))
    ball = with_material(e3d.icosphere(0.2, 2), color=e3d.linear(0.9, 0.9, 0.2))
    scene.add(ball, translation=(-0.9, 0.2, 0.5), cast_shadows=False)
    scene.add(ball, translation=(-0.7, 0.2, -0.3), receive_shadows=False)
    scene.add(ball, translation=(1.6, 3.0, 1.8), scale=(2, 2, 2))  # above the picture
    for kind in kinds:
        lamp(scene, kind)
    camera = camera_at((1.3, 1.7, 2.2), (0, 0.3, 0))
    return Picture(scene, camera, samples=samples, options=options)


variant("exact_shadow_sun", table, ["sun"])
variant("exact_shadow_point", table, ["point"])
variant("exact_shadow_spot", table, ["spot"])
variant("exact_shadow_all", table, ["sun", "point", "spot"], shading="forward")
variant("exact_shadow_physical", table, ["sun", "spot"], physical=True)
variant("exact_shadow_samples", table, ["sun", "point"], samples=4)
variant("exact_shadow_flat", table, ["point"], normals="flat", hidden_surfaces="painter")
variant("exact_shadow_unlit", table, ["point"], mode="unlit")


def foliage(filter_kind):
    """Holes let light through, panes that are seen through count where they are half opaque."""
    scene = e3d.Scene(background=(90, 110, 140), ambient=e3d.linear(0.15, 0.15, 0.15))
    scene.add(floor(4.0, color=e3d.linear(0.8, 0.8, 0.75)))
    shapes = [("mask", "repeat", 0.6), ("mask", "mirror", 0.5), ("blend", "clamp", 0.5)]
    for k, (mode, wrap, cutoff) in enumerate(shapes):
        texture = leaf(filter=filter_kind, wrap=wrap)
        mesh = pane((1, 1, 1, 0.9), size=0.7, texture=texture, alpha_mode=mode, alpha_cutoff=cutoff)
        mesh.uvs = np.asarray(mesh.uvs) * (1 + k) - 0.3 * k
        mesh.colors = np.array([(255, 255, 255, 255), (255, 255, 255, 160)] * 2, np.uint8)
        scene.add(mesh, translation=(0.8 * k - 0.8, 0, 0.1 * k), euler=(0.1, 0.4, 0))
    for k, alpha in enumerate((0.3, 0.7)):
        glass = pane(e3d.linear(0.4, 0.8, 1, alpha), 1, size=0.6, alpha_mode="blend")
        scene.add(glass, translation=(0.6 * k - 0.2, 0, 0.7))
    scene.add(e3d.DirectionalLight((-0.3, -0.7, -0.6), intensity=0.4 * np.pi, shadow="exact"))
    lamp(scene, "point", range=3.0)
    return Picture(scene, camera_at((0.9, 1.6, 2.4), (0, 0.3, 0.2)))


for _filter in ("nearest", "bilinear", "trilinear"):
    variant(f"exact_shadow_holes_{_filter}", foliage, _filter)


def shards(kind, seed):
    """Triangles of all sizes, thin ones, ones without area and ones around the light."""
    rng = np.random.default_rng(seed)
    count = 400
    middle = rng.uniform(-1.5, 1.5, (count, 1, 3))
    size = 10.0 ** rng.uniform(-3, -0.7, (count, 1, 1))
    size[::80] = 2.0
    corners = middle + size * rng.normal(size=(count, 3, 3))
    corners[::9, 2] = corners[::9, 1] + (corners[::9, 0] - corners[::9, 1]) * 1e-5  # slivers
    corners[1::50, 2] = corners[1::50, 1]
    corners = np.round(corners * 64) / 64 if seed % 2 else corners  # rays through corners and edges
    mesh = e3d.Mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
    mesh = with_material(mesh, color=e3d.linear(0.8, 0.8, 0.8), two_sided=True, flat_shading=True)
    scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(0.1, 0.1, 0.1))
    scene.add(mesh)
    scene.add(floor(6.0, color=e3d.linear(0.8, 0.7, 0.6)), translation=(0, -1, 0))
    if kind == "sun":
        direction = (0, -1, 0) if seed % 2 else rng.normal(size=3)
        scene.add(e3d.DirectionalLight(direction, shadow="exact"))
    else:
        light = e3d.PointLight(
            intensity=2 * np.pi, shadow="exact", range=np.inf if seed % 2 else 2.5
        )
        scene.add(light, translation=np.round(rng.uniform(-0.5, 0.5, 3) * 8) / 8)
    return Picture(scene, camera_at((1.5, 1.9, 3.5), (0, 0, 0)))


for _seed in range(4):
    variant(f"exact_shadow_shards_sun_{_seed}", shards, "sun", _seed)
    variant(f"exact_shadow_shards_point_{_seed}", shards, "point", _seed)


def crowd(batching):
    """Instances and nodes that share a mesh, at mirrored, stretched and tiny poses."""
    scene = e3d.Scene(background=(30, 30, 40), ambient=e3d.linear(0.1, 0.1, 0.1))
    scene.add(floor(4.0, color=e3d.linear(0.7, 0.7, 0.7)))
    mesh = with_material(e3d.cylinder(), color=CORAL)
    poses = np.array([(0.4 * k - 1.2, 0.2, -0.5 + 0.1 * k, 0.1 + 0.03 * k) for k in range(7)])
    scene.add(e3d.InstancedMesh(mesh, poses.astype(np.float32)))
    for k in range(4):
        scale = (-0.2, 0.3, 0.2) if k % 2 else (0.1, 0.2 + 0.1 * k, 0.3)
        scene.add(mesh, translation=(0.5 * k - 0.8, 0.3, 0.5), scale=scale)
    for kind in ("sun", "point"):
        lamp(scene, kind)
    return Picture(scene, camera_at((1.0, 1.6, 2.4), (0, 0.2, 0)), options={"batching": batching})


variant("exact_shadow_crowd", crowd, True)
variant("exact_shadow_crowd_apart", crowd, False)


def porch(kinds, softness, samples=1, physical=False, **options):
    """Few faces under soft lights: flat ones, smooth ones, mirrored ones, one with holes, glass."""
    surface = {"metallic": 0.2, "roughness": 0.5} if physical else {}
    scene = e3d.Scene(background=(20, 24, 34), ambient=e3d.linear(0.08, 0.08, 0.1))
    scene.add(floor(3.0, color=e3d.linear(0.7, 0.7, 0.7), **surface))
    crate = with_material(e3d.box(0.5), color=CORAL, **surface)
    scene.add(crate, translation=(-0.3, 0.25, 0.1), euler=(0, 0.5, 0))
    ball = with_material(e3d.icosphere(0.3, 1), color=TEAL, **surface)
    scene.add(ball, translation=(0.5, 0.35, 0.3), scale=(-1, 1, 1))
    texture = leaf(filter="bilinear", wrap="repeat")
    scene.add(
        pane((1, 1, 1), size=0.6, texture=texture, alpha_mode="mask"), translation=(0, 0.4, 0.6)
    )
    glass = pane(e3d.linear(0.4, 0.8, 1, 0.7), 1, size=0.4, alpha_mode="blend")
    scene.add(glass, translation=(-0.7, 0.5, 0.5))
    for kind in kinds:
        if kind == "sun":
            scene.add(e3d.DirectionalLight(SUN_WAY, shadow="exact", shadow_softness=softness))
        else:
            lamp(scene, kind, shadow_softness=softness)
    return Picture(scene, camera_at((1.3, 1.7, 2.2), (0, 0.3, 0)), samples=samples, options=options)


variant("exact_soft_sun", porch, ["sun"], 0.15)
variant("exact_soft_point", porch, ["point"], 0.1, normals="flat")
variant("exact_soft_spot", porch, ["spot"], 0.3, shading="forward")
variant("exact_soft_wide", porch, ["sun", "point"], 1.5, physical=True)


def crumbs(kind):
    """Triangles in all directions, few of them, some through corners and edges of others."""
    rng = np.random.default_rng(11)
    corners = rng.uniform(-1, 1, (40, 1, 3)) + 0.3 * rng.normal(size=(40, 3, 3))
    mesh = e3d.Mesh(np.round(corners.reshape(-1, 3) * 16) / 16, np.arange(120).reshape(-1, 3))
    mesh = with_material(mesh, color=e3d.linear(0.8, 0.8, 0.8), two_sided=True, flat_shading=True)
    scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(0.1, 0.1, 0.1))
    scene.add(mesh)
    scene.add(floor(6.0, color=e3d.linear(0.8, 0.7, 0.6)), translation=(0, -1, 0))
    if kind == "sun":
        scene.add(e3d.DirectionalLight((0, -1, 0), shadow="exact", shadow_softness=0.5))
    else:
        light = e3d.PointLight(intensity=2 * np.pi, shadow="exact", shadow_softness=0.25)
        scene.add(light, translation=(0.25, 0.5, 0.125))
    return Picture(scene, camera_at((1.5, 1.9, 3.5), (0, 0, 0)))


variant("exact_soft_crumbs_sun", crumbs, "sun")
variant("exact_soft_crumbs_point", crumbs, "point")
