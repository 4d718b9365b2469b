"""linalg against numpy.linalg, math and known values; conventions; argument errors."""

import contextlib
import math
from fractions import Fraction

import numpy as np
import pytest

from engine3d import linalg
from engine3d.errors import InvalidArgumentError

RNG = np.random.default_rng(20)


def random_quaternions(count):
    q = RNG.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def random_pose():
    return linalg.compose(RNG.normal(size=3), RNG.normal(size=4), RNG.uniform(0.2, 3.0, 3))


# --- trigonometry -------------------------------------------------------------------------------


def exact_sine(x):
    """Sine of a double in rational arithmetic, good to 2**-200."""
    pi = Fraction(
        31415926535897932384626433832795028841971693993751058209749445923078164062862, 10**76
    )
    x = Fraction(x)
    x -= round(x / (2 * pi)) * 2 * pi
    total, term, n = Fraction(0), x, 1
    while abs(term) > Fraction(1, 2**200):
        total += term
        term = -term * x * x / ((n + 1) * (n + 2))
        term = Fraction(round(term * 2**240), 2**240)
        n += 2
    return total


@pytest.mark.parametrize("scale", [1e-8, 1.0, 10.0, 1000.0])
def test_sine_is_within_two_ulps_of_the_exact_value(scale):
    for x in RNG.uniform(-scale, scale, 100):
        exact = float(exact_sine(x))
        assert abs(linalg.sin(x) - exact) <= 2.0 * math.ulp(exact)


def test_trigonometry_agrees_with_math_on_many_angles():
    x = np.concatenate((RNG.uniform(-7, 7, 20000), RNG.uniform(-1e6, 1e6, 20000)))
    np.testing.assert_allclose(linalg.sin(x), np.sin(x), rtol=4e-16, atol=3e-16)
    np.testing.assert_allclose(linalg.cos(x), np.cos(x), rtol=4e-16, atol=3e-16)
    np.testing.assert_allclose(linalg.tan(x), np.tan(x), rtol=1e-13)


def test_trigonometry_of_special_angles():
    assert linalg.sin(0.0) == 0.0 and linalg.cos(0.0) == 1.0
    assert linalg.sin(math.pi) == pytest.approx(1.2246467991473532e-16, rel=1e-12)
    assert isinstance(linalg.sin(1), float)
    assert np.isnan(linalg.sin(math.inf)) and np.isnan(linalg.cos(math.nan))
    assert abs(linalg.sin(1e15) - math.sin(1e15)) < 0.1  # an angle known to an eighth of a radian


def test_arc_tangent_agrees_with_math_in_every_direction():
    y, x = RNG.normal(size=(2, 20000))
    np.testing.assert_allclose(linalg.atan2(y, x), np.arctan2(y, x), rtol=4e-16)
    axes = [(0.0, 0.0), (0.0, 2.0), (2.0, 0.0), (0.0, -2.0), (-2.0, 0.0), (3.0, 3.0), (-3.0, -3.0)]
    for y, x in axes:
        assert linalg.atan2(y, x) == math.atan2(y, x)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 7, 8, 12, 16, 24, 32, 48, 100, 1000])
def test_unit_circle_is_symmetric_to_the_bit(count):
    x, y = linalg.unit_circle(count)
    angle = 2.0 * math.pi * np.arange(count) / count
    np.testing.assert_allclose(x, np.cos(angle), atol=1e-15)
    np.testing.assert_allclose(y, np.sin(angle), atol=1e-15)
    np.testing.assert_array_equal(x[1:], x[:0:-1])
    np.testing.assert_array_equal(y[1:], -y[:0:-1])
    if count % 4 == 0:
        quarter = count // 4
        assert (x[0], y[0]) == (1, 0) and (x[quarter], y[quarter]) == (0, 1)
        np.testing.assert_array_equal(np.roll(x, quarter), y)


# --- vectors ------------------------------------------------------------------------------------


def test_vector_products_agree_with_numpy():
    a, b = RNG.normal(size=(2, 50, 3))
    np.testing.assert_allclose(linalg.cross(a, b), np.cross(a, b), atol=1e-15)
    np.testing.assert_allclose(linalg.dot(a, b), np.sum(a * b, axis=1), atol=1e-14)
    np.testing.assert_allclose(linalg.length(a), np.linalg.norm(a, axis=1), rtol=1e-15)
    assert linalg.cross(a[:, None], b).shape == (50, 50, 3)


def test_normalize_handles_null_tiny_and_huge_vectors():
    v = np.array([[0, 0, 0], [3e-200, 0, 4e-200], [3e200, 4e200, 0], [0, 0, 5e-324]])
    expected = [[0, 0, 0], [0.6, 0, 0.8], [0.6, 0.8, 0], [0, 0, 1]]
    np.testing.assert_allclose(linalg.normalize(v), expected, rtol=1e-15)


@pytest.mark.parametrize("function", [linalg.dot, linalg.cross])
def test_products_of_wrong_shape_are_argument_errors(function):
    with pytest.raises(InvalidArgumentError, match="shape"):
        function([1, 2], [1, 2, 3])
    with pytest.raises(InvalidArgumentError, match="numbers"):
        function([1, 2, "x"], [1, 2, 3])


# --- matrices -----------------------------------------------------------------------------------


def test_rotations_turn_counter_clockwise():
    x, y, z = np.eye(3)
    quarter = math.pi / 2
    for rotation, start, end in (
        (linalg.rotation_x, y, z),
        (linalg.rotation_y, z, x),
        (linalg.rotation_z, x, y),
    ):
        turned = linalg.transform_directions(rotation(quarter), start)
        np.testing.assert_allclose(turned, end, atol=1e-16)
    for axis, rotation in zip(
        np.eye(3), (linalg.rotation_x, linalg.rotation_y, linalg.rotation_z), strict=True
    ):
        np.testing.assert_allclose(linalg.rotation_axis(axis * 7, 0.3), rotation(0.3), atol=1e-15)


def test_multiply_agrees_with_matmul_and_takes_stacks():
    a, b, c = RNG.normal(size=(3, 10, 4, 4))
    np.testing.assert_allclose(linalg.multiply(a, b), a @ b, atol=1e-14)
    np.testing.assert_allclose(linalg.multiply(a, b, c), a @ b @ c, atol=1e-13)
    np.testing.assert_allclose(linalg.multiply(a[0], b), a[0] @ b, atol=1e-14)


def test_inverse_agrees_with_numpy():
    m = RNG.normal(size=(100, 4, 4))
    np.testing.assert_allclose(linalg.inverse(m), np.linalg.inv(m), rtol=1e-8, atol=1e-10)
    pose = random_pose()
    inverse = linalg.inverse(pose)
    assert inverse[3].tolist() == [0, 0, 0, 1]
    np.testing.assert_allclose(linalg.multiply(inverse, pose), np.eye(4), atol=1e-14)


def test_inverse_of_a_projection():
    projection = linalg.perspective(0.9, 1.5, 0.1, 100.0)
    product = linalg.multiply(linalg.inverse(projection), projection)
    np.testing.assert_allclose(product, np.eye(4), atol=1e-12)


@pytest.mark.parametrize("matrix", [np.zeros((4, 4)), np.full((4, 4), np.nan), np.ones((4, 4))])
def test_inverse_of_a_singular_matrix_is_an_argument_error(matrix):
    with pytest.raises(InvalidArgumentError, match="no inverse"):
        linalg.inverse(matrix)


def test_transform_points_and_directions():
    m = linalg.multiply(linalg.translation((1, 2, 3)), linalg.scaling((2, 3, 4)))
    np.testing.assert_array_equal(linalg.transform_points(m, [1, 1, 1]), [3, 5, 7])
    np.testing.assert_array_equal(linalg.transform_directions(m, [[1, 1, 1]]), [[2, 3, 4]])
    assert linalg.transform_points(m, np.zeros((0, 3))).shape == (0, 3)


def test_transform_points_divides_by_w():
    projection = linalg.perspective(1.0, 1.0, 1.0, 10.0)
    corners = linalg.transform_points(projection, [[0, 0, -1], [0, 0, -10]])
    np.testing.assert_allclose(corners, [[0, 0, -1], [0, 0, 1]], atol=1e-15)


def test_normal_matrix_keeps_normals_perpendicular():
    for _ in range(20):
        m = random_pose()
        u, v = RNG.normal(size=(2, 3))
        normal = np.cross(u, v)
        moved = linalg.normal_matrix(m) @ normal
        assert abs(np.dot(moved, linalg.transform_directions(m, u))) < 1e-12
        np.testing.assert_allclose(linalg.normal_matrix(m), np.linalg.inv(m[:3, :3]).T, rtol=1e-10)
    assert linalg.normal_matrix(np.stack([m, m])).shape == (2, 3, 3)


def test_normal_matrix_of_a_flattened_object_gives_the_remaining_direction():
    np.testing.assert_array_equal(
        linalg.normal_matrix(linalg.scaling((2, 3, 0))), np.diag([0.0, 0.0, 6.0])
    )


def test_compose_and_decompose_are_inverse():
    for _ in range(50):
        offset, scale = RNG.normal(size=3), RNG.uniform(0.1, 5.0, 3)
        rotation = random_quaternions(1)[0]
        m = linalg.compose(offset, rotation, scale)
        expected = linalg.multiply(
            linalg.translation(offset), linalg.quaternion_to_matrix(rotation), linalg.scaling(scale)
        )
        np.testing.assert_allclose(m, expected, atol=1e-14)
        parts = linalg.decompose(m)
        np.testing.assert_allclose(parts[0], offset)
        np.testing.assert_allclose(parts[2], scale, rtol=1e-14)
        np.testing.assert_allclose(linalg.compose(*parts), m, atol=1e-14)


def test_decompose_shows_a_reflection_along_x():
    offset, rotation, scale = linalg.decompose(np.diag([2.0, -3.0, 4.0, 1.0]))
    np.testing.assert_allclose(scale, [-2, 3, 4])
    np.testing.assert_allclose(
        linalg.compose(offset, rotation, scale), np.diag([2.0, -3.0, 4.0, 1.0]), atol=1e-15
    )


def test_compose_takes_one_scale_for_all_axes():
    np.testing.assert_array_equal(linalg.compose(scale=2.0), np.diag([2.0, 2.0, 2.0, 1.0]))


def test_matrix_shape_errors():
    with pytest.raises(InvalidArgumentError, match=r"\(\.\.\., 4, 4\)"):
        linalg.multiply(np.eye(3), np.eye(4))
    with pytest.raises(InvalidArgumentError, match=r"\(4, 4\)"):
        linalg.transform_points(np.zeros((2, 4, 4)), [1, 2, 3])
    with pytest.raises(InvalidArgumentError, match="offset"):
        linalg.translation(3.0)


# --- quaternions --------------------------------------------------------------------------------


def test_quaternion_product_is_the_matrix_product():
    a, b = random_quaternions(2)
    np.testing.assert_allclose(
        linalg.quaternion_to_matrix(linalg.quaternion_multiply(a, b)),
        linalg.multiply(linalg.quaternion_to_matrix(a), linalg.quaternion_to_matrix(b)),
        atol=1e-15,
    )


def test_quaternion_and_matrix_are_inverse_for_every_largest_component():
    for q in [*random_quaternions(200), *np.eye(4), *-np.eye(4)]:
        m = linalg.quaternion_to_matrix(q)
        np.testing.assert_allclose(m[:3, :3] @ m[:3, :3].T, np.eye(3), atol=1e-15)
        assert np.linalg.det(m) == pytest.approx(1.0)
        back = linalg.matrix_to_quaternion(m)
        assert back[3] >= 0.0
        np.testing.assert_allclose(back * np.sign(np.dot(back, q)), q, atol=1e-15)
        np.testing.assert_array_equal(linalg.matrix_to_quaternion(m[:3, :3]), back)


def test_quaternions_need_not_be_of_unit_length():
    q = np.array([1.0, 2.0, -3.0, 4.0])
    np.testing.assert_allclose(
        linalg.quaternion_to_matrix(5 * q), linalg.quaternion_to_matrix(q), atol=1e-15
    )
    with pytest.raises(InvalidArgumentError, match="length greater than zero"):
        linalg.quaternion_to_matrix(np.zeros(4))


def test_quaternion_conjugate_undoes_a_rotation():
    q = random_quaternions(5)
    identity = linalg.quaternion_multiply(q, linalg.quaternion_conjugate(q))
    np.testing.assert_allclose(identity, np.tile([0, 0, 0, 1], (5, 1)), atol=1e-15)


def test_axis_angle():
    q = linalg.quaternion_from_axis_angle([0, 0, 2], math.pi / 2)
    np.testing.assert_allclose(q, [0, 0, math.sqrt(0.5), math.sqrt(0.5)], rtol=1e-15)
    with pytest.raises(InvalidArgumentError, match="axis"):
        linalg.quaternion_from_axis_angle([0, 0, 0], 1.0)


@pytest.mark.parametrize("order", ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"])
def test_euler_angles_turn_about_the_objects_own_axes(order):
    angles = RNG.uniform(-3, 3, 3)
    rotation = {
        "X": linalg.rotation_x(angles[0]),
        "Y": linalg.rotation_y(angles[1]),
        "Z": linalg.rotation_z(angles[2]),
    }
    expected = linalg.multiply(*(rotation[name] for name in order))
    q = linalg.euler_to_quaternion(angles, order)
    np.testing.assert_allclose(linalg.quaternion_to_matrix(q), expected, atol=1e-15)


def test_euler_order_must_be_a_permutation():
    with pytest.raises(InvalidArgumentError, match="permutation"):
        linalg.euler_to_quaternion([0, 0, 0], "XXZ")


# --- viewing ------------------------------------------------------------------------------------


def test_look_at_maps_the_target_onto_the_line_of_sight():
    eye, target = np.array([3.0, 4.0, 5.0]), np.array([-1.0, 0.5, 2.0])
    pose = linalg.look_at(eye, target)
    np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), atol=1e-15)
    assert np.linalg.det(pose) == pytest.approx(1.0)
    seen = linalg.transform_points(linalg.inverse(pose), target)
    np.testing.assert_allclose(seen, [0, 0, -np.linalg.norm(eye - target)], atol=1e-14)
    assert pose[1, 1] > 0.0  # up stays up
    np.testing.assert_array_equal(pose[:3, 3], eye)


def test_look_at_from_the_z_axis_is_a_translation():
    np.testing.assert_array_equal(
        linalg.look_at((0, 0, 5), (0, 0, 0)), linalg.translation((0, 0, 5))
    )


@pytest.mark.parametrize("eye", [(0, 3, 0), (0, -3, 0)])
def test_look_at_along_up_still_gives_a_rotation(eye):
    pose = linalg.look_at(eye, (0, 0, 0))
    np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), atol=1e-15)
    np.testing.assert_allclose(pose[:3, 2], np.array(eye) / 3.0)


def test_look_at_needs_two_positions():
    with pytest.raises(InvalidArgumentError, match="different"):
        linalg.look_at((1, 2, 3), (1, 2, 3))


def test_perspective_maps_the_frustum_to_the_clip_cube():
    projection = linalg.perspective(math.pi / 2, 2.0, 0.5, 20.0)
    corners = [[2 * 0.5, 0.5, -0.5], [-2 * 20.0, -20.0, -20.0]]
    np.testing.assert_allclose(
        linalg.transform_points(projection, corners), [[1, 1, -1], [-1, -1, 1]], rtol=1e-14
    )


def test_perspective_without_a_far_plane_is_the_limit():
    np.testing.assert_allclose(
        linalg.perspective(1.0, 1.5, 0.1), linalg.perspective(1.0, 1.5, 0.1, 1e15), rtol=1e-14
    )
    np.testing.assert_array_equal(
        linalg.perspective(1.0, 1.5, 0.1), linalg.perspective(1.0, 1.5, 0.1, math.inf)
    )


def test_orthographic_maps_the_box_to_the_clip_cube():
    projection = linalg.orthographic(4.0, 3.0, 1.0, 9.0)
    np.testing.assert_allclose(
        linalg.transform_points(projection, [[4, 3, -1], [-4, -3, -9]]),
        [[1, 1, -1], [-1, -1, 1]],
        rtol=1e-15,
    )


@pytest.mark.parametrize(
    "arguments",
    [
        (0.0, 1.0, 0.1, 10.0),
        (math.pi, 1.0, 0.1, 10.0),
        (math.nan, 1.0, 0.1, 10.0),
        (1.0, 0.0, 0.1, 10.0),
        (1.0, 1.0, 0.0, 10.0),
        (1.0, 1.0, 1.0, 1.0),
        (1.0, 1.0, 1.0, math.nan),
    ],
)
def test_perspective_argument_errors(arguments):
    with pytest.raises(InvalidArgumentError):
        linalg.perspective(*arguments)


@pytest.mark.parametrize("arguments", [(0, 1, 0, 1), (1, -1, 0, 1), (1, 1, 2, 1), (1, 1, 0, 1e999)])
def test_orthographic_argument_errors(arguments):
    with pytest.raises(InvalidArgumentError):
        linalg.orthographic(*arguments)


# --- one thing in plain floats, many in arrays --------------------------------------------------

# Zeros of both signs, tiny and huge numbers among ordinary ones.
ODD_NUMBERS = np.array([0.0, -0.0, 1.0, -1.0, 1e-308, -5e-324, 1e154, -1e200, 0.1, 3.0, -7.5])


def odd(*shape):
    numbers = RNG.normal(size=shape) * 10.0 ** RNG.integers(-3, 4, shape)
    return np.where(RNG.random(shape) < 0.3, RNG.choice(ODD_NUMBERS, shape), numbers)


def same_bits(single, among_others):
    return np.asarray(single).tobytes() == np.asarray(among_others).tobytes()


def invertible(m):
    with np.errstate(all="ignore"), contextlib.suppress(InvalidArgumentError):
        return linalg.inverse(m[np.newaxis])[0]


def test_one_matrix_has_the_bits_it_has_among_many():
    poses = [random_pose() for _ in range(500)]
    for m in (*poses, *odd(500, 4, 4), *(np.triu(m) for m in odd(500, 4, 4))):
        expected = invertible(m)
        if expected is not None:
            assert same_bits(linalg.inverse(m), expected)
        else:
            with pytest.raises(InvalidArgumentError):
                linalg.inverse(m)
    with np.errstate(all="ignore"):
        for a, b in odd(1000, 2, 4, 4):
            product, expected = linalg.multiply(a, b), linalg.multiply(a[np.newaxis], b)[0]
            is_number = ~np.isnan(expected)  # the bits of NaN tell nothing
            np.testing.assert_array_equal(~np.isnan(product), is_number)
            assert same_bits(product[is_number], expected[is_number])


def test_one_vector_has_the_bits_it_has_among_many():
    for v in (*odd(2000, 3), *RNG.normal(size=(1000, 3)), np.zeros(3), np.array([-0.0, 0, -0.0])):
        assert same_bits(linalg.normalize(v), linalg.normalize(v[np.newaxis])[0])
    with np.errstate(all="ignore"):
        for v in ([math.nan, 1, 2], [1, math.inf, 2], [1, 2, -math.inf]):
            np.testing.assert_array_equal(linalg.normalize(v), linalg.normalize([v])[0])


def test_one_quaternion_has_the_bits_it_has_among_many():
    for q in (*odd(1000, 4), *RNG.normal(size=(1000, 4))):
        with np.errstate(all="ignore"):
            if 0.0 < q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] < math.inf:
                expected = linalg.quaternion_to_matrix(q[np.newaxis])[0]
                assert same_bits(linalg.quaternion_to_matrix(q), expected)
    for q in (np.zeros(4), [1e200, 0, 0, 0], [math.nan, 0, 0, 1]):
        with pytest.raises(InvalidArgumentError), np.errstate(all="ignore"):
            linalg.quaternion_to_matrix(q)


def test_one_angle_has_the_bits_it_has_among_many():
    angles = [*ODD_NUMBERS, *RNG.uniform(-7, 7, 3000), *RNG.uniform(-3e6, 3e6, 3000)]
    angles += [k * math.pi / 4 for k in range(-20, 20)] + [2.0**20, -(2.0**20), 2.0**20 + 0.5]
    for angle in map(float, angles):
        for function in (linalg.sin, linalg.cos, linalg.tan):
            single, among_others = function(angle), function(np.array([angle]))[0]
            assert type(single) is float
            assert same_bits(single, among_others), angle


def test_look_at_has_the_bits_of_its_formula():
    for eye, target, up in RNG.normal(size=(500, 3, 3)):
        backward = linalg.normalize((eye - target)[np.newaxis])
        right = linalg.normalize(linalg.cross(linalg.normalize(up[np.newaxis]), backward))
        upward = linalg.cross(backward, right)
        pose = linalg.look_at(eye, target, up)
        assert same_bits(pose[:3, :3].T.copy(), np.concatenate([right, upward, backward]))
