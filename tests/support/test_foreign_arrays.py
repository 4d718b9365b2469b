"""Arrays of other libraries, in all that takes arrays; frames handed to other libraries."""

import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.base.foreign_arrays import is_foreign_array

CUDA = 2


class Tensor:
    """An array that offers DLPack and nothing else, as those of the array API's libraries."""

    def __init__(self, array, device=1):
        self.array, self.device = np.ascontiguousarray(array), device

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**{key: one for key, one in options.items() if one})

    def __dlpack_device__(self):
        return self.device, 0


class Interface:
    """An array that offers ``__array_interface__`` and nothing else."""

    def __init__(self, array):
        self.array = array

    @property
    def __array_interface__(self):
        return self.array.__array_interface__


class OnCuda:
    """An array in the memory of a graphics card, as Numba's are."""

    __cuda_array_interface__ = {"shape": (3, 3), "typestr": "<f4", "data": (0, False), "version": 3}

    def __array__(self, dtype=None, copy=None):
        raise TypeError("implicit conversion is not allowed")


class WithGradient(Tensor):
    """A tensor of PyTorch that needs its gradient."""

    def __dlpack__(self, **options):
        raise BufferError("Can't export tensors that require gradient, use tensor.detach()")


POINTS = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
FACES = np.array([(0, 1, 2)], np.int64)
PIXELS = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
POSE = np.eye(4)

#: Calls that take one array, and that array.
TAKERS = {
    "Mesh.positions": (lambda given: e3d.Mesh(given, FACES).positions, POINTS),
    "Mesh.faces": (lambda given: e3d.Mesh(POINTS, given).faces, FACES),
    "Mesh.normals": (lambda given: e3d.Mesh(POINTS, FACES, normals=given).normals, POINTS + 1),
    "Mesh.uvs": (lambda given: e3d.Mesh(POINTS, FACES, uvs=given).uvs, POINTS[:, :2]),
    "Mesh.colors": (lambda given: e3d.Mesh(POINTS, FACES, colors=given).colors, PIXELS[0, :3]),
    "Mesh.values": (lambda given: valued(given), np.array([1.0, 2, 3])),
    "Texture": (lambda given: e3d.Texture(given).pixels, PIXELS),
    "Environment": (lambda given: e3d.Environment(given).pixels, np.ones((2, 4, 3), np.float32)),
    "pose": (lambda given: e3d.Scene().add(e3d.box(), pose=given).pose, POSE),
    "translation": (lambda given: e3d.Scene().add(translation=given).translation, POINTS[1]),
    "instances": (lambda given: e3d.InstancedMesh(e3d.box(), given).poses, POSE[None]),
    "linalg": (lambda given: e3d.linalg.multiply(given, np.eye(4)), POSE),
    "look_at": (lambda given: e3d.look_at(given, (0, 0, 0)), np.array([1.0, 2, 3])),
    "render": (lambda given: e3d.render(given, size=(8, 6)).color, POINTS),
    "Canvas": (lambda given: e3d.Canvas(given).pixels, np.zeros((4, 3, 4), np.uint8)),
    "rasterize": (lambda given: rasterized(given), np.ones((3, 4), np.float32)),
    "Material.color": (lambda given: e3d.Material(color=given).color, np.array([0.5, 0.25, 1.0])),
    "Scene.background": (lambda given: e3d.Scene(background=given).background, PIXELS[0, 1]),
    "linear": (lambda given: e3d.linear(given), np.array([2.0, 0.5, 1.0])),
    "frame_bounds": (lambda given: e3d.frame_bounds(given)[1], np.array([[0, 0, 0], [1, 1, 1.0]])),
}


def valued(given):
    mesh = e3d.Mesh(POINTS, FACES)
    mesh.values["height"] = e3d.Values(given, on="vertices")
    return mesh.values["height"]


def rasterized(given):
    return e3d.rasterization.rasterize(given, FACES, (4, 4)).face_id


@pytest.mark.parametrize("kind", [Tensor, Interface])
@pytest.mark.parametrize("name", TAKERS)
def test_arrays_of_other_libraries_count_as_numpys(name, kind):
    if name in ("render", "Canvas") and kind is Interface:
        pytest.skip("what is drawn is told by its type")
    call, array = TAKERS[name]
    if name == "Canvas" and not np.from_dlpack(kind(array)).flags.writeable:
        pytest.skip("this NumPy makes arrays of other libraries read-only")
    assert np.array_equal(np.asarray(call(kind(array))), np.asarray(call(array)))


@pytest.mark.parametrize("name", TAKERS)
def test_memory_of_another_device_is_refused_by_name(name):
    call, array = TAKERS[name]
    for given in (OnCuda(), Tensor(array, CUDA)):
        with pytest.raises(
            e3d.InvalidArgumentError, match="copy it to the host first, by tensor"
        ) as said:
            call(given)
        assert "is not an array" not in str(said.value)


def test_what_a_library_says_is_passed_on():
    with pytest.raises(e3d.InvalidArgumentError, match=r"positions: \w+\.WithGradient does not ha"):
        e3d.Mesh(WithGradient(POINTS), FACES)


def test_a_mesh_keeps_its_own_copy():
    array = POINTS.copy()
    mesh = e3d.Mesh(Tensor(array), FACES)
    array[:] = 7
    assert np.array_equal(mesh.positions, POINTS)


def test_a_canvas_draws_into_the_memory_of_another_library():
    array = np.zeros((4, 3, 4), np.uint8)
    if np.from_dlpack(Tensor(array)).flags.writeable:
        e3d.Canvas(Tensor(array)).clear("red")
        assert array[0, 0].tolist() == [255, 0, 0, 255]


@pytest.fixture(scope="module")
def frame():
    return e3d.render(e3d.box(), size=(8, 6), outputs=("color", "depth"))


def test_a_frame_hands_its_colour_over_without_a_copy(frame):
    for array in (np.from_dlpack(frame), np.asarray(frame)):
        assert array.dtype == np.uint8 and np.shares_memory(array, frame.color)
        assert np.array_equal(array, frame.color)
    assert np.asarray(frame, np.float32).dtype == np.float32
    assert frame.__dlpack_device__() == (1, 0) and is_foreign_array(frame)
    assert np.array_equal(e3d.Texture(frame).pixels, frame.color)


@pytest.mark.skipif(sys.version_info < (3, 12), reason="classes offer buffers from Python 3.12 on")
def test_a_frame_is_a_buffer(frame):
    view = memoryview(frame)
    assert view.shape == (6, 8, 4) and view.format == "B"
    assert bytes(view) == frame.color.tobytes()
    view[0, 0, 0] = 9
    assert frame.color[0, 0, 0] == 9


def test_a_frame_without_colour_says_so():
    depth = e3d.render(e3d.box(), size=(8, 6), outputs=("depth",))
    for export in (np.from_dlpack, np.asarray, memoryview):
        with pytest.raises((e3d.errors.MissingOutputError, TypeError), match="color|bytes-like"):
            export(depth)


def test_tensors_of_pytorch():
    torch = pytest.importorskip("torch", exc_type=ImportError)
    mesh = e3d.Mesh(torch.from_numpy(POINTS), torch.from_numpy(FACES))
    assert np.array_equal(mesh.positions, POINTS)
    with pytest.raises(e3d.InvalidArgumentError, match="torch.Tensor does not hand its numbers"):
        e3d.Mesh(torch.ones((3, 3), requires_grad=True), FACES)
    assert torch.from_dlpack(e3d.render(mesh, size=(8, 6))).shape == (6, 8, 4)


#: Calls that take one number, and that number.
NUMBERS = {
    "size": (lambda given: e3d.Renderer((given, 3)).width, 8),
    "intensity": (lambda given: e3d.PointLight(intensity=given).intensity, 2.5),
    "roughness": (lambda given: e3d.Material(roughness=given).roughness, 0.25),
    "color": (lambda given: e3d.Material(color=[given, 0, 0]).color, 128),
    "linear": (lambda given: e3d.linear(given, 1, 1), 2.0),
    "fov": (lambda given: e3d.PerspectiveCamera(given).yfov, 0.5),
    "scale": (lambda given: e3d.Scene().add(e3d.box(), scale=given).scale, 2.0),
    "subdivisions": (lambda given: e3d.icosphere(1.0, given).positions, 2),
    "line_width": (lambda given: e3d.RenderOptions(line_width=given).line_width, 3.0),
}


def arrays_of(library):
    """Return what makes an array of a library; NumPy's are the arrays without axes themselves."""
    module = pytest.importorskip(library, exc_type=ImportError)
    return module.tensor if library == "torch" else module.asarray


@pytest.mark.parametrize("library", ["numpy", "torch", "jax.numpy"])
@pytest.mark.parametrize("name", NUMBERS)
def test_an_element_of_an_array_is_a_number(name, library):
    call, number = NUMBERS[name]
    assert np.array_equal(call(arrays_of(library)(number)), call(number))


@pytest.mark.parametrize("library", ["numpy", "torch", "jax.numpy"])
def test_several_numbers_are_not_one(library):
    with pytest.raises(e3d.InvalidArgumentError, match="intensity must be"):
        e3d.PointLight(intensity=arrays_of(library)([1.0]))


@pytest.mark.parametrize("name", TAKERS)
def test_arrays_of_jax(name):
    call, array = TAKERS[name]
    if name == "Canvas":
        pytest.skip("arrays of JAX cannot be drawn into")
    given = arrays_of("jax.numpy")(array)
    assert np.array_equal(np.asarray(call(given)), np.asarray(call(np.asarray(given))))
