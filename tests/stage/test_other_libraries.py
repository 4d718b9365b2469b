"""Datasets of PyVista, meshes of meshio and geometries of Open3D are drawn as they are."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.errors import Engine3DWarning, InvalidArgumentError
from engine3d.io.scenes.other_libraries import library_of, scene_of_library
from engine3d.model.materials.colors import srgb_bytes

POINTS = np.array(
    [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], np.float64
)
BESIDE = POINTS[[1, 2, 5, 6]] + (1, 0, 0)


def only_mesh(thing):
    (node,) = scene_of_library(thing).nodes
    return node.object


def area(mesh):
    a, b, c = np.moveaxis(mesh.positions[mesh.faces].astype(np.float64), 1, 0)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def volume(mesh):
    """The volume within a closed mesh whose faces all look outwards."""
    a, b, c = np.moveaxis(mesh.positions[mesh.faces].astype(np.float64), 1, 0)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


class TestMeshio:
    @pytest.fixture(autouse=True)
    def meshio(self):
        self.meshio = pytest.importorskip("meshio", exc_type=ImportError)

    def test_outer_faces_of_volumes_look_outwards(self):
        both = [[0, 1, 2, 3, 4, 5, 6, 7], [1, 8, 9, 2, 5, 10, 11, 6]]
        mesh = only_mesh(self.meshio.Mesh(np.vstack([POINTS, BESIDE]), {"hexahedron": both}))
        assert len(mesh.faces) == 20 and volume(mesh) == pytest.approx(2)
        tetra = only_mesh(self.meshio.Mesh(POINTS[[0, 1, 3, 4]], {"tetra": [[0, 1, 2, 3]]}))
        assert volume(tetra) == pytest.approx(1 / 6)
        wedge = only_mesh(self.meshio.Mesh(POINTS[[0, 3, 1, 4, 7, 5]], {"wedge": [range(6)]}))
        assert volume(wedge) == pytest.approx(0.5) and len(wedge.faces) == 8
        pyramid = only_mesh(self.meshio.Mesh(POINTS[[0, 1, 2, 3, 4]], {"pyramid": [range(5)]}))
        assert volume(pyramid) == pytest.approx(1 / 3)

    def test_polygons_lines_and_points_in_two_dimensions(self):
        cells = [
            ("triangle", [[0, 1, 2]]),
            ("quad", [[0, 1, 2, 3]]),
            ("line", [[0, 2]]),
            ("vertex", [[3]]),
        ]
        mesh = only_mesh(self.meshio.Mesh(POINTS[:4, :2], cells))
        assert area(mesh) == pytest.approx(1.5)
        assert mesh.lines.tolist() == [[0, 2]] and mesh.points.tolist() == [3]

    def test_numbers_of_cells_are_those_of_their_faces(self):
        both = [[0, 1, 2, 3, 4, 5, 6, 7], [1, 8, 9, 2, 5, 10, 11, 6]]
        cells = [("line", [[0, 6]]), ("hexahedron", both), ("quad", [[0, 1, 5, 4]])]
        given = self.meshio.Mesh(np.vstack([POINTS, BESIDE]), cells)
        given.cell_data = {
            "which": [[9], [1, 2], [3]],
            "forces": [np.ones((n, 3)) for n in (1, 2, 1)],
        }
        mesh = only_mesh(given)
        middles = mesh.positions[mesh.faces].mean(axis=1)
        expected = np.where(middles[2:, 0] > 1, 2, 1)
        assert mesh.values["which"][:2].tolist() == [3, 3]
        assert mesh.values["which"][2:].tolist() == expected.tolist()
        assert mesh.values["forces"].shape == (22, 3)

    def test_numbers_that_do_not_fit_cells_are_left_out(self):
        given = self.meshio.Mesh(POINTS, [("triangle", [[0, 1, 2]]), ("quad", [[0, 1, 5, 4]])])
        given.cell_data = {"few": [[1.0]], "uneven": [np.ones((1, 2)), np.ones((1, 3))]}
        with pytest.warns(Engine3DWarning, match="cell data '(few|uneven)' do not fit") as told:
            assert not only_mesh(given).values
        assert len(told) == 2 and told[0].filename == __file__

    def test_cells_that_are_not_drawn_are_named(self):
        faces = [[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]]
        given = self.meshio.Mesh(
            POINTS, [("polyhedron4", faces), ("triangle", [[0, 1, 2]]), ("triangle", [])]
        )
        with pytest.warns(Engine3DWarning, match="type polyhedron4 are not drawn") as told:
            assert len(only_mesh(given).faces) == 1
        assert len(told) == 1 and told[0].filename == __file__

    @pytest.mark.parametrize(
        ("kind", "rows", "said"),
        [
            ("triangle", [[0, 1, 8]], "hold the index 8, but there are 8 points"),
            ("tetra", [[0, 1, 2, -1]], "hold the index -1"),
            ("quad", [[0, 1, 2, 1 << 40]], "hold the index 1099511627776"),
            ("polygon", [[0, 1, 1 << 32]], "hold the index 4294967296"),
            ("line", [[0, 1.5]], "must be integers"),
            ("hexahedron", [[0, 1, 2]], r"of shape \(C, 8\)"),
            ("triangle", [[0, 1]], r"of shape \(C, 3\)"),
            ("vertex", [0, 1], r"of shape \(C, 1\)"),
        ],
    )
    def test_wrong_cells_are_refused(self, kind, rows, said):
        given = self.meshio.Mesh(POINTS, {})
        given.cells = [self.meshio.CellBlock(kind, rows if kind == "polygon" else np.array(rows))]
        with pytest.raises(InvalidArgumentError, match=f"^{kind} cells .*{said}"):
            e3d.render(given, size=(8, 6))

    @pytest.mark.parametrize("points", [None, "abc", np.zeros(3), np.zeros((3, 4))])
    def test_wrong_points_are_refused(self, points):
        given = self.meshio.Mesh(POINTS, {})
        given.points = points
        with pytest.raises(InvalidArgumentError, match="^points "):
            e3d.render(given, size=(8, 6))

    def test_data_of_points_colours_the_picture(self):
        given = self.meshio.Mesh(POINTS, {"quad": [[0, 1, 2, 3]]}, point_data={"t": np.arange(8.0)})
        assert only_mesh(given).values["t"].tolist() == list(range(8))
        plain, hot = (
            e3d.render(given, size=(32, 24), **how).color for how in ({}, {"color_by": "t"})
        )
        assert not np.array_equal(plain, hot)


class TestPyvista:
    @pytest.fixture(autouse=True)
    def pyvista(self):
        self.pyvista = pytest.importorskip("pyvista", exc_type=ImportError)

    def test_polygons_keep_their_numbers(self):
        cube = self.pyvista.Cube()
        cube.cell_data["side"] = np.arange(6)
        cube.point_data["height"] = cube.points[:, 2]
        mesh = only_mesh(cube)
        assert volume(mesh) == pytest.approx(1) and mesh.crease_angle < 1
        assert sorted(mesh.values["side"].tolist()) == [n // 2 for n in range(12)]
        assert np.array_equal(mesh.values["height"], mesh.positions[:, 2])
        assert not mesh.edge_visible.all()

    def test_the_surface_of_volumes(self):
        grid = self.pyvista.ImageData(dimensions=(3, 4, 5))
        grid.cell_data["count"] = np.arange(24)
        mesh = only_mesh(grid)
        assert area(mesh) == pytest.approx(2 * (6 + 8 + 12)) and "count" in mesh.values

    def test_lines_points_strips_and_what_is_empty(self):
        line = only_mesh(self.pyvista.Line(resolution=3))
        assert line.lines.tolist() == [[0, 1], [1, 2], [2, 3]]
        two = self.pyvista.Line() + self.pyvista.Line((0, 1, 0), (1, 1, 0), resolution=2)
        assert len(only_mesh(two).lines) == 3
        assert only_mesh(self.pyvista.PolyData(POINTS)).points.tolist() == list(range(8))
        strips = self.pyvista.Sphere().strip()
        assert area(only_mesh(strips)) == pytest.approx(self.pyvista.Sphere().area)
        assert len(only_mesh(self.pyvista.PolyData()).positions) == 0

    def test_blocks_are_nodes(self):
        inner = self.pyvista.MultiBlock({"b": self.pyvista.Cube(), "none": None})
        blocks = self.pyvista.MultiBlock({"a": self.pyvista.Sphere(), "inner": inner})
        assert [node.name for node in scene_of_library(blocks).nodes] == ["a", "b"]

    def test_classes_of_programs_count(self):
        class Part(self.pyvista.PolyData):
            pass

        part = Part(self.pyvista.Sphere())
        assert library_of(part) == "pyvista"
        assert e3d.render(part, size=(16, 12)).stats["triangles"] > 100

    def test_what_shows_nothing_is_refused(self):
        with pytest.raises(InvalidArgumentError):
            e3d.render(self.pyvista.Camera(), size=(16, 12))


class TestOpen3d:
    @pytest.fixture(autouse=True)
    def open3d(self):
        self.open3d = pytest.importorskip("open3d", exc_type=ImportError)
        self.make = self.open3d.geometry
        self.vectors = self.open3d.utility.Vector3dVector

    def ball(self):
        mesh = self.make.TriangleMesh.create_sphere()
        mesh.vertex_colors = self.vectors(np.linspace(0, 1, 3 * len(mesh.vertices)).reshape(-1, 3))
        return mesh

    def dice(self):
        mesh = self.make.TriangleMesh.create_box(create_uv_map=True)
        images = [np.full((2, 2, 3), (255, 0, 0)), np.array([[[0, 255, 0]] * 2, [[0, 0, 255]] * 2])]
        mesh.textures = [self.make.Image(one.astype(np.uint8)) for one in images]
        mesh.triangle_material_ids = self.open3d.utility.IntVector([0] * 8 + [1] * 4)
        return mesh

    def cells(self, *places):
        cloud = self.make.PointCloud(self.vectors(np.array(places, float) + 0.5))
        cloud.paint_uniform_color([0.2, 0.4, 0.6])
        return self.make.VoxelGrid.create_from_point_cloud_within_bounds(
            cloud, 1.0, [0, 0, 0], [5, 5, 5]
        )

    def test_meshes_keep_colours_and_normals(self):
        given = self.ball()
        mesh = only_mesh(given)
        assert not mesh.has_normals and mesh.crease_angle < 1
        assert e3d.render(mesh, size=(8, 6)).color is not None
        expected = np.round(np.asarray(given.vertex_colors) * 255)
        assert np.array_equal(srgb_bytes(mesh.colors)[:, :3], expected)
        given.compute_vertex_normals()
        assert np.allclose(only_mesh(given).normals, given.vertex_normals, atol=1e-6)
        assert area(mesh) == pytest.approx(given.get_surface_area(), rel=1e-5)

    def test_textures_lie_as_in_open3d(self):
        """The first row of an image of a mesh is at v = 0."""
        mesh = only_mesh(self.dice())
        assert mesh.material_ids.tolist() == [0] * 8 + [1] * 4 and mesh.colors is None
        red, both = (material.texture.pixels for material in mesh.materials)
        assert red[0, 0, :3].tolist() == [255, 0, 0]
        assert both[-1, 0, :3].tolist() == [0, 255, 0] and both[0, 0, :3].tolist() == [0, 0, 255]
        assert area(mesh) == pytest.approx(6) and len(mesh.uvs) == 36

    def test_materials_without_an_image_count(self):
        """As of OBJ files, whose first material is an empty one."""
        image, numbers = self.open3d.geometry.Image, [0] * 6 + [1] * 6
        given = self.make.TriangleMesh.create_box(create_uv_map=True)
        given.textures = [image(), image(np.full((2, 2, 3), 9, np.uint8))]
        given.triangle_material_ids = self.open3d.utility.IntVector(numbers)
        mesh = only_mesh(given)
        assert mesh.material_ids.tolist() == numbers
        assert [one.texture is None for one in mesh.materials] == [True, False]

    def test_points_and_lines(self):
        cloud = self.make.PointCloud(self.vectors(POINTS))
        assert only_mesh(cloud).points.tolist() == list(range(8))
        lines = self.make.LineSet(
            self.vectors(POINTS), self.open3d.utility.Vector2iVector([[0, 6]])
        )
        assert only_mesh(lines).lines.tolist() == [[0, 6]]
        lines.colors = self.vectors([[1, 0, 0]])
        mesh = only_mesh(lines)
        assert np.allclose(mesh.positions[mesh.lines[0]], POINTS[[0, 6]])
        assert srgb_bytes(mesh.colors)[:, :3].tolist() == [[255, 0, 0]] * 2

    def test_boxes_are_those_of_open3d(self):
        turn = self.make.get_rotation_matrix_from_xyz((0.3, 0.4, 0.5))
        straight = self.make.AxisAlignedBoundingBox([0, 0, 0], [1, 2, 3])
        turned = self.make.OrientedBoundingBox([1, 1, 1], turn, [1, 2, 1])
        lines = self.make.LineSet
        for box, as_lines in (
            (straight, lines.create_from_axis_aligned_bounding_box(straight)),
            (turned, lines.create_from_oriented_bounding_box(turned)),
        ):
            mesh = only_mesh(box)
            assert np.allclose(mesh.positions, as_lines.points, atol=1e-6)
            assert np.array_equal(mesh.lines, as_lines.lines)

    def test_only_bare_faces_of_voxels_are_drawn(self):
        grid = self.cells((0, 0, 0), (1, 0, 0), (3, 3, 3), (3, 4, 3))
        mesh = only_mesh(grid)
        assert area(mesh) == pytest.approx(20) and volume(mesh) == pytest.approx(4)
        assert len(mesh.faces) == 40 and len(mesh.edges()) > 0
        assert (srgb_bytes(mesh.colors)[:, :3] == [51, 102, 153]).all()

    def test_any_voxels_enclose_what_they_are(self):
        for seed in range(5):
            places = np.unique(np.random.default_rng(seed).integers(0, 5, (30, 3)), axis=0)
            mesh = only_mesh(self.cells(*places))
            assert volume(mesh) == pytest.approx(len(places))

    def test_octrees_and_tetrahedra(self):
        cloud = self.make.PointCloud(self.vectors(POINTS))
        cloud.paint_uniform_color([1, 0, 0])
        tree = self.make.Octree(2)
        tree.convert_from_point_cloud(cloud, 0.01)
        mesh = only_mesh(tree)
        assert len(mesh.faces) == 12 * 8 and len(mesh.lines) % 12 == 0
        assert volume(mesh) == pytest.approx(8 * (tree.size / 4) ** 3)
        tetra = self.make.TetraMesh(
            self.vectors(POINTS[[0, 1, 3, 4]]), self.open3d.utility.Vector4iVector([[0, 1, 2, 3]])
        )
        assert volume(only_mesh(tetra)) == pytest.approx(1 / 6)

    def test_tensors_and_lists(self):
        tensor = self.open3d.t.geometry.TriangleMesh.from_legacy(self.ball())
        assert area(only_mesh(tensor)) == pytest.approx(area(only_mesh(self.ball())))
        cloud = self.make.PointCloud(self.vectors(POINTS))
        both = scene_of_library([self.ball(), cloud])
        assert [node.name for node in both.nodes] == ["TriangleMesh", "PointCloud"]
        assert scene_of_library([]) is None and scene_of_library([cloud, 3]) is None
        shown = e3d.render([self.ball(), cloud.translate([3, 0, 0])], size=(32, 24)).color
        assert not np.array_equal(shown, e3d.render(self.ball(), size=(32, 24)).color)

    def test_models_keep_their_materials(self):
        rendering = self.open3d.visualization.rendering
        model, record = rendering.TriangleMeshModel(), rendering.MaterialRecord()
        record.shader, record.base_color = "defaultLit", [1.0, 0.0, 0.0, 1.0]
        record.base_metallic, record.base_roughness, record.base_reflectance = 1.0, 0.25, 0.9
        maps = {"ao_img": (4, 4), "roughness_img": (2, 2), "metallic_img": (2, 4)}
        for name, size in maps.items():
            setattr(record, name, self.make.Image(np.full((*size, 1), 100, np.uint8)))
        model.meshes = [rendering.TriangleMeshModel.MeshInfo(self.dice(), "die", 0)]
        model.materials = [record]
        (node,) = scene_of_library(model).nodes
        (material,) = node.object.materials
        assert node.name == "die" and (material.metallic, material.roughness) == (1.0, 0.25)
        assert material.metallic_roughness_texture.pixels.shape[:2] == (2, 4)
        assert (material.metallic_roughness_texture.pixels[..., :3] == 100).all()
        reflected = ((material.ior - 1) / (material.ior + 1)) ** 2 * material.specular_intensity
        assert reflected == pytest.approx(0.16 * 0.9**2, rel=1e-5)

    def test_wrong_indices_are_refused(self):
        mesh = self.make.TriangleMesh(
            self.vectors(POINTS), self.open3d.utility.Vector3iVector([[0, 1, 8]])
        )
        with pytest.raises(InvalidArgumentError, match="triangles hold the index 8"):
            e3d.render(mesh, size=(8, 6))
        die = self.dice()
        die.triangle_material_ids = self.open3d.utility.IntVector([2] * 12)
        with pytest.raises(InvalidArgumentError, match=r"triangle_material_ids must be in 0\.\.1"):
            e3d.render(die, size=(8, 6))

    def test_what_shows_nothing_is_refused(self):
        with pytest.raises(InvalidArgumentError):
            e3d.render(self.make.Image(np.zeros((2, 2, 3), np.uint8)), size=(8, 6))
        for empty in (self.make.TriangleMesh(), self.make.VoxelGrid(), self.make.PointCloud()):
            assert len(only_mesh(empty).positions) == 0


def test_what_is_of_no_library():
    assert library_of(e3d.box()) is None and scene_of_library(3) is None
    within: list = []
    within.append(within)
    assert scene_of_library(within) is None


EMPTY = {
    "trimesh": (lambda of: of.Trimesh(), lambda of: of.Scene()),
    "pyvista": (lambda of: of.PolyData(), lambda of: of.MultiBlock([None])),
    "open3d": (lambda of: of.geometry.TriangleMesh(), lambda of: of.geometry.PointCloud()),
}


@pytest.mark.parametrize("library", EMPTY)
def test_what_has_no_points_is_a_warning(library):
    package = pytest.importorskip(library, exc_type=ImportError)
    for make in EMPTY[library]:
        thing = make(package)
        told = f"this {type(thing).__name__} has no points"
        with pytest.warns(e3d.errors.Engine3DWarning, match=told) as caught:
            e3d.render(thing, size=(16, 12))
        assert len(caught) == 1, [str(one.message) for one in caught]
