"""Scenes of Open3D's legacy geometries, drawn by its own `Visualizer` and by the engine's.

Run as a program, it writes what Open3D itself draws: ``python open3d_scenes.py OUT.npz``.
"""

import itertools
import json
import sys

import numpy as np
import open3d as o3d

geometry, Points = o3d.geometry, o3d.utility.Vector3dVector
ASIDE = {"front": [0.4, 0.5, 0.6]}
SIZE = (200, 150)


def random(*shape):
    return np.random.default_rng(sum(shape)).random(shape)


def torus():
    mesh = geometry.TriangleMesh.create_torus()
    mesh.compute_vertex_normals()
    mesh.paint_uniform_color([0.8, 0.3, 0.1])
    return mesh


def ball(colored=True):
    mesh = geometry.TriangleMesh.create_sphere()
    mesh.compute_vertex_normals()
    if colored:
        mesh.vertex_colors = Points(random(len(mesh.vertices), 3))
    return mesh


def bowl():
    mesh = ball()
    mesh.remove_triangles_by_index(list(range(500)))
    return mesh


def cloud(normals=False):
    points = geometry.PointCloud(Points(random(800, 3)))
    points.colors = Points(random(800, 3))
    if normals:
        points.estimate_normals()
    return points


def lines():
    made = geometry.LineSet.create_from_triangle_mesh(
        geometry.TriangleMesh.create_sphere(resolution=6)
    )
    made.colors = Points(random(len(made.lines), 3))
    return made


def boxes():
    turn = geometry.get_rotation_matrix_from_xyz((0.3, 0.4, 0.5))
    straight = geometry.AxisAlignedBoundingBox([0, 0, 0], [1, 2, 3])
    turned = geometry.OrientedBoundingBox([1, 1, 1], turn, [1, 2, 1])
    straight.color, turned.color = (1, 0, 0), (0, 0, 1)
    return [straight, turned]


def voxels():
    return geometry.VoxelGrid.create_from_point_cloud(cloud(), 0.1)


def tetrahedra():
    return geometry.TetraMesh.create_from_point_cloud(geometry.PointCloud(Points(random(40, 3))))[0]


def dice(normals):
    mesh = geometry.TriangleMesh.create_box(create_uv_map=True)
    if normals:
        mesh.compute_vertex_normals()
    images = [(random(8, 8, 3) * 255).astype(np.uint8), (random(5, 9, 3) * 255).astype(np.uint8)]
    mesh.textures = [geometry.Image(image) for image in images]
    mesh.triangle_material_ids = o3d.utility.IntVector([0, 1] * 6)
    return mesh


def scenes():
    """Yield names, geometries, options, values of the view, and steps of its field of view."""
    colors, shades = o3d.visualization.MeshColorOption, o3d.visualization.MeshShadeOption
    smooth = {"mesh_shade_option": shades.Color}
    below = {"front": [0.2, -1.0, 0.3], "zoom": 0.6}
    yield "flat", [torus()], {}, {}, 0
    yield "smooth", [torus()], smooth, {"up": [0, 0, 1], "front": [0.4, 0.5, 0.6]}, 0
    yield "near", [torus()], {}, {**ASIDE, "zoom": 0.3, "lookat": [0.5, 0.2, 0]}, 0
    yield "no normals", [geometry.TriangleMesh.create_sphere()], {}, {}, 0
    yield "colours", [ball()], {}, {}, 0
    yield "no light", [ball()], {"light_on": False}, {}, 0
    yield "by x", [ball()], {"mesh_color_option": colors.XCoordinate}, {}, 0
    yield "by normal", [ball()], {"mesh_color_option": colors.Normal}, {}, 0
    yield "backs culled", [bowl()], {}, below, 0
    yield "backs", [bowl()], {"mesh_show_back_face": True}, below, 0
    yield "backs smooth", [bowl()], {"mesh_show_back_face": True, **smooth}, below, 0
    dark = {"point_size": 3.0, "background_color": np.array([0.1, 0.2, 0.3])}
    yield "points", [cloud()], dark, {}, 0
    yield "uncoloured points", [geometry.PointCloud(Points(random(500, 3)))], {}, ASIDE, 0
    yield "lit points", [cloud(normals=True)], {}, {}, 0
    normal = {"point_color_option": o3d.visualization.PointColorOption.Normal}
    yield "points by normal", [cloud(normals=True)], normal, {}, 0
    yield "lines", [lines()], {}, ASIDE, 0
    yield "boxes", boxes(), {}, ASIDE, 0
    yield "voxels", [voxels()], {}, ASIDE, 0
    yield "tetrahedra", [tetrahedra()], {}, ASIDE, 0
    yield "textures", [dice(True)], {}, ASIDE, 0
    yield "plain textures", [dice(False)], {}, ASIDE, 0
    yield "together", [torus(), cloud(), lines()], {}, ASIDE, 0
    yield "parallel", [torus()], {}, ASIDE, -20
    yield "wide", [torus()], {}, {**ASIDE, "zoom": 0.4}, 5


def draw(make, geometries, options, view, lens):
    """Return colours as bytes, (H, W, 3), and depths, (H, W)."""
    visualizer = make()
    assert visualizer.create_window(width=SIZE[0], height=SIZE[1], visible=False)
    for one in geometries:
        assert visualizer.add_geometry(one)
    for name, value in options.items():
        setattr(visualizer.get_render_option(), name, value)
    control = visualizer.get_view_control()
    if lens:
        control.change_field_of_view(step=lens)
    for name, value in view.items():
        getattr(control, f"set_{name}")(value)
    color = np.asarray(visualizer.capture_screen_float_buffer(do_render=True)).copy()
    depth = np.asarray(visualizer.capture_depth_float_buffer(do_render=True)).copy()
    visualizer.destroy_window()
    return np.round(color * 255.0).astype(np.uint8), depth


def walks():
    """Yield lists of calls of a view control: (name, arguments)."""
    rng = np.random.default_rng(3)
    calls = {
        "set_zoom": lambda: (rng.uniform(0.1, 1.5),),
        "set_front": lambda: (rng.normal(size=3),),
        "set_up": lambda: (rng.normal(size=3),),
        "set_lookat": lambda: (rng.normal(size=3),),
        "rotate": lambda: tuple(rng.uniform(-300, 300, 2)),
        "translate": lambda: tuple(rng.uniform(-50, 50, 2)),
        "scale": lambda: (rng.uniform(-9, 9),),
        "camera_local_translate": lambda: tuple(rng.normal(size=3)),
        "camera_local_rotate": lambda: tuple(rng.uniform(-90, 90, 2)),
        "change_field_of_view": lambda: (rng.uniform(-4, 4),),
        "reset_camera_local_rotate": lambda: (),
    }
    for _ in range(30):
        names = rng.choice(list(calls), 6)
        yield [(str(name), calls[str(name)]()) for name in names]


def states(make):
    """Return the state of the view after each walk: status, intrinsic and extrinsic matrices."""
    found = []
    for walk in walks():
        visualizer = make()
        visualizer.create_window(width=SIZE[0], height=SIZE[1], visible=False)
        visualizer.add_geometry(torus())
        control = visualizer.get_view_control()
        for name, values in walk:
            getattr(control, name)(*values)
        (status,) = json.loads(visualizer.get_view_status())["trajectory"]
        parameters = control.convert_to_pinhole_camera_parameters()
        # What was written is read by another view, which must show the same.
        other = make()
        other.create_window(width=SIZE[0], height=SIZE[1], visible=False)
        other.add_geometry(torus())
        took = other.get_view_control().convert_from_pinhole_camera_parameters(parameters, True)
        (again,) = json.loads(other.get_view_status())["trajectory"]
        numbers = [[one[key] for key in sorted(one)] for one in (status, again)]
        matrices = parameters.intrinsic.intrinsic_matrix, parameters.extrinsic
        flat = [np.ravel(np.hstack([np.ravel(part) for part in one])) for one in numbers]
        found.append(np.hstack([*flat, *map(np.ravel, matrices), [float(took)]]))
        visualizer.destroy_window()
        other.destroy_window()
    return np.array(found)


def main(path):
    make = o3d.visualization.Visualizer
    if not make().create_window(width=8, height=8, visible=False):
        sys.exit("Open3D cannot draw here")
    drawn = [draw(make, *scene[1:]) for scene in scenes()]
    rows = {
        f"{kind}{number}": one
        for number, pair in enumerate(drawn)
        for kind, one in zip(("color", "depth"), pair, strict=True)
    }
    np.savez_compressed(path, states=states(make), **rows)


NAMES = [name for name, *_ in scenes()] if __name__ != "__main__" else []

if __name__ == "__main__":
    main(*itertools.islice(sys.argv, 1, 2))
