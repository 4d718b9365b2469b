"""Draws the picture of docs/open3d.md; needs the package open3d.

    python docs/pictures/open3d_scene.py

In: geometries of Open3D. Out: open3d.webp in this folder: a `Visualizer`, its wires and depths, and
the offscreen renderer's light.
"""

from pathlib import Path

import numpy as np
import open3d as o3d
from open3d.visualization import rendering
from PIL import Image

from engine3d.compat.open3d import install

WIDTH, HEIGHT = 270, 270


def geometries():
    """Return a ring, a ball of voxels, a box of lines and a cloud of points."""
    make = o3d.geometry
    ring = make.TriangleMesh.create_torus(1.0, 0.35, 60, 40)
    ring.compute_vertex_normals()
    ring.paint_uniform_color([0.85, 0.4, 0.15])
    turn = np.linspace(0, 26 * np.pi, 1500)
    rise = np.linspace(-1, 1, 1500)
    wide = np.sqrt(1 - rise**2)
    ball = np.stack([wide * np.cos(turn), rise, wide * np.sin(turn)], axis=1) * 0.62
    cloud = make.PointCloud(o3d.utility.Vector3dVector(ball))
    cloud.colors = o3d.utility.Vector3dVector(np.stack([0.5 + rise / 2, 1 - abs(rise), wide], 1))
    voxels = make.VoxelGrid.create_from_point_cloud(cloud, 0.16)
    cloud.scale(2.9, [0, 0, 0])
    box = ring.get_axis_aligned_bounding_box()
    box.color = (0.1, 0.2, 0.5)
    return ring, voxels, cloud, box


def visualized(things, **options):
    """Return colours, (H, W, 3) uint8, and depths, (H, W), of a Visualizer."""
    vis = o3d.visualization.Visualizer()
    vis.create_window(width=WIDTH, height=HEIGHT, visible=False)
    for one in things:
        vis.add_geometry(one)
    for name, value in options.items():
        setattr(vis.get_render_option(), name, value)
    control = vis.get_view_control()
    control.set_front([0.5, 0.45, 0.75])
    control.set_zoom(0.62)
    color = np.asarray(vis.capture_screen_float_buffer(True))
    depth = np.asarray(vis.capture_depth_float_buffer(True))
    vis.destroy_window()
    return np.round(color * 255).astype(np.uint8), depth


def offscreen(ring, voxels):
    """Return colours of the offscreen renderer, (H, W, 3) uint8."""
    renderer = rendering.OffscreenRenderer(WIDTH, HEIGHT)
    ground = o3d.geometry.TriangleMesh.create_box(7, 0.1, 7).translate([-3.5, -1.5, -3.5])
    ground.compute_vertex_normals()
    ground.paint_uniform_color([0.75, 0.75, 0.75])
    for name, one, roughness in (("ring", ring, 0.35), ("ground", ground, 1.0)):
        material = rendering.MaterialRecord()
        material.shader, material.base_roughness = "defaultLit", roughness
        renderer.scene.add_geometry(name, one, material)
    renderer.scene.add_geometry("voxels", voxels, rendering.MaterialRecord())
    renderer.setup_camera(42.0, [0, -0.3, 0], [2.3, 1.7, 3.5], [0, 1, 0])
    return np.asarray(renderer.render_to_image())


def main() -> None:
    install()
    ring, voxels, cloud, box = geometries()
    plain, depth = visualized([ring, voxels, cloud, box], point_size=2.0)
    wires, _ = visualized([ring, voxels], mesh_show_wireframe=True)
    near = np.where(depth > 0, np.clip(255 * (2.3 / np.maximum(depth, 1e-9)) ** 1.6, 0, 255), 0)
    grey = np.repeat(near.astype(np.uint8)[..., None], 3, axis=2)
    row = np.hstack([plain, wires, grey, offscreen(ring, voxels)])
    Image.fromarray(row).save(Path(__file__).with_name("open3d.webp"), lossless=True, method=6)


if __name__ == "__main__":
    main()
