"""Open3D's function `draw`: its arguments, what geometries wear, and the camera of its window."""

import numpy as np
import pytest

o3d = pytest.importorskip("open3d", exc_type=ImportError)

from compat.open3d_scenes import cloud, lines, torus  # noqa: E402

import engine3d as e3d  # noqa: E402
from engine3d.compat.open3d import draw, drawing_functions  # noqa: E402
from engine3d.errors import Engine3DWarning, InvalidArgumentError  # noqa: E402
from engine3d.stage.view_renderer import ViewRenderer  # noqa: E402
from engine3d.stage.viewed_thing import viewed_of  # noqa: E402
from engine3d.stage.views.first_view import view_of_scene  # noqa: E402

RED = np.full((4, 4, 3), (250, 0, 0), np.uint8)


@pytest.fixture
def shown(monkeypatch):
    """What a window would show: a function that returns it."""
    held = []
    monkeypatch.setattr(drawing_functions, "show_viewed", lambda *given: held.append(given))

    def show(*arguments, **named):
        draw(*arguments, **named)
        return held.pop()

    return show


def picture(viewed, settings, size):
    with ViewRenderer(viewed, settings, size) as renderer:
        view = view_of_scene(renderer) or renderer.filling_view()
        return renderer.draw(view, outputs=("color", "object_id"))


def only_mesh(viewed):
    (node,) = (one for one in viewed.scene.nodes if isinstance(one.object, e3d.Mesh))
    return node.object


def box_with_uvs():
    mesh = o3d.geometry.TriangleMesh.create_box(create_uv_map=True)
    mesh.triangle_material_ids = o3d.utility.IntVector([0] * 12)
    return mesh


def test_arguments_have_open3ds_order(shown):
    viewed, _, size = shown(torus(), "Ring", 60, 40, None, [0, 0, 0], [0, 0, 5], [0, 1, 0], 50.0)
    assert (viewed.title, size) == ("Ring", (60, 40))
    camera = viewed.scene.data.camera_node()
    assert camera.world_pose[:3, 3].tolist() == [0, 0, 5]
    assert camera.object.yfov == pytest.approx(np.radians(50))


def test_a_pinhole_camera_is_looked_through(shown):
    mesh = o3d.geometry.TriangleMesh.create_sphere(0.1)
    extrinsic = np.eye(4)
    extrinsic[:3, 3] = 1.0, 0.5, 4.0
    intrinsic = np.array([[80.0, 0, 40.0], [0, 80.0, 20.0], [0, 0, 1]])
    given = {"intrinsic_matrix": intrinsic, "extrinsic_matrix": extrinsic}
    frame = picture(*shown(mesh, width=100, height=60, **given))
    rows, columns = np.nonzero(frame.object_id >= 0)
    assert columns.mean() + 0.5 == pytest.approx(40 + 80 * 1.0 / 4, abs=0.6)
    assert rows.mean() + 0.5 == pytest.approx(20 + 80 * 0.5 / 4, abs=0.6)
    with pytest.raises(InvalidArgumentError, match="intrinsic_matrix"):
        shown(mesh, intrinsic_matrix=np.eye(2), extrinsic_matrix=np.eye(4))


def test_sizes_and_planes_are_those_of_the_call(shown):
    given = {"point_size": 9, "line_width": 4, "near_plane": 0.5, "far_plane": 80.0}
    _, settings, _ = shown([cloud(), lines()], show_axes=True, **given)
    assert (settings.appearance["point_size"], settings.appearance["line_width"]) == (9, 4)
    assert (settings.near, settings.far, settings.axes) == (0.5, 80.0, True)
    assert not {"point_size", "line_width"} & set(shown([cloud(), lines()])[1].appearance)


def test_sizes_of_materials_are_one_size(shown):
    record = o3d.visualization.rendering.MaterialRecord()
    record.shader, record.point_size = "defaultUnlit", 12
    row = {"geometry": cloud(), "material": record}
    assert shown([row, torus()], point_size=5)[1].appearance["point_size"] == 12
    with pytest.warns(Engine3DWarning, match="one point_size, the largest: 12"):
        assert shown([row, cloud()], point_size=5)[1].appearance["point_size"] == 12


def test_what_is_passed_over_is_named(shown):
    asked = {"raw_mode": True, "on_init": print, "bg_image": np.zeros((2, 2)), "new": np.eye(2)}
    with pytest.warns(Engine3DWarning, match="not support bg_image, new, on_init, raw_mode$"):
        shown(torus(), **asked)
    with pytest.warns(Engine3DWarning, match="not support group, time of a geometry"):
        shown({"geometry": torus(), "group": "rings", "time": 1.5})
    shown(torus(), raw_mode=False, animation_time_step=1, ibl=None)


def test_textures_of_a_mesh_show(shown):
    mesh = box_with_uvs()
    mesh.textures = [o3d.geometry.Image(RED)]
    (material,) = only_mesh(shown(mesh)[0]).materials
    assert (material.texture.pixels[..., :3] == RED).all() and material.unlit
    mesh.compute_vertex_normals()
    (material,) = only_mesh(shown(mesh)[0]).materials
    assert not material.unlit


def tensor_with_material():
    tensor = o3d.t.geometry.TriangleMesh.from_legacy(box_with_uvs())
    tensor.compute_vertex_normals()
    material = tensor.material
    material.set_default_properties()
    material.material_name = "defaultLit"
    material.texture_maps["albedo"] = o3d.t.geometry.Image(o3d.core.Tensor(RED))
    material.vector_properties["base_color"] = [1.0, 0.5, 0.5, 1.0]
    material.scalar_properties["roughness"] = 0.25
    return tensor


def test_the_material_of_a_tensor_mesh_shows(shown):
    tensor = tensor_with_material()
    for found in (only_mesh(shown(tensor)[0]), only_mesh(viewed_of(tensor))):
        (material,) = found.materials
        assert (material.texture.pixels[..., :3] == RED).all()
        assert material.roughness == 0.25 and material.rgb[1] == pytest.approx(0.5)


def test_models_show_each_mesh_in_its_material(shown):
    model = o3d.visualization.rendering.TriangleMeshModel()
    part = o3d.visualization.rendering.TriangleMeshModel.MeshInfo(torus(), "ring", 0)
    record = o3d.visualization.rendering.MaterialRecord()
    record.shader, record.base_color = "defaultUnlit", [0.0, 1.0, 0.0, 1.0]
    model.meshes, model.materials = [part], [record]
    viewed = shown(model)[0]
    assert only_mesh(viewed).materials[0].color[:3] == (0.0, 1.0, 0.0)
    assert [node.name for node in viewed.scene.nodes] == ["Object 1:ring"]
