"""Random robots as URDF, and where their links are by matrices of NumPy's own."""

from typing import NamedTuple

import numpy as np

KINDS = ("fixed", "revolute", "continuous", "prismatic", "floating", "planar", "spherical")
SHAPES = (
    '<box size="{0} {1} {2}"/>',
    '<cylinder radius="{0}" length="{1}"/>',
    '<sphere radius="{0}"/>',
    '<capsule radius="{0}" length="{1}"/>',
)


class Built(NamedTuple):
    """A robot's text, values of its joints, and root-from-link of all links."""

    text: str
    values: dict
    poses: dict


def words(numbers):
    return " ".join(repr(float(number)) for number in np.ravel(numbers))


def euler(roll, pitch, yaw):
    (a, b, c), (x, y, z) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    about_x = np.array([[1, 0, 0], [0, a, -x], [0, x, a]])
    about_y = np.array([[b, 0, y], [0, 1, 0], [-y, 0, b]])
    about_z = np.array([[c, -z, 0], [z, c, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def pose(xyz=(0, 0, 0), turn=None):
    made = np.eye(4)
    made[:3, 3] = xyz
    made[:3, :3] = np.eye(3) if turn is None else turn
    return made


def about(axis, angle):
    """Rodrigues' formula."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)


def moved(kind, axis, value):
    if kind == "prismatic":
        return pose(axis * value)
    if kind in ("revolute", "continuous"):
        return pose(turn=about(axis, value))
    if kind == "floating":
        return pose(value[:3], euler(*value[3:]))
    if kind == "spherical":
        return pose(turn=euler(*value))
    if kind == "planar":
        cross = np.cross([0, 0, 1], axis)
        length = np.linalg.norm(cross)
        angle = np.arctan2(length, axis[2])
        frame = about(cross / length, angle) if length > 1e-9 else np.eye(3)
        return pose(value[0] * frame[:, 0] + value[1] * frame[:, 1], about(axis, value[2]))
    return np.eye(4)


def robot(seed, links=9):
    """Return a random robot: a tree in random order, some joints of which follow others."""
    random = np.random.default_rng(seed)
    parts, values, poses, form = [], {}, {"l0": np.eye(4)}, {}
    for number in range(links):
        shape = str(random.choice(SHAPES)).format(*random.uniform(0.05, 0.5, 3))
        origin = (
            f'<origin xyz="{words(random.normal(size=3))}" rpy="{words(random.normal(size=3))}"/>'
        )
        parts.append(
            f'<link name="l{number}"><visual>{origin}<geometry>{shape}</geometry></visual></link>'
        )
    for number in range(1, links):
        kind, parent = str(random.choice(KINDS)), int(random.integers(number))
        xyz, rpy, axis = random.normal(size=(3, 3))
        unit = axis / np.linalg.norm(axis)
        name, mimic, value = f"j{number}", "", None
        single = [one for one in values if np.isscalar(values[one])]
        if kind in ("revolute", "continuous", "prismatic"):
            if single and random.random() < 0.4:
                led, factor, offset = str(random.choice(single)), *random.normal(size=2).tolist()
                mimic = f'<mimic joint="{led}" multiplier="{factor!r}" offset="{offset!r}"/>'
                value = factor * values[led] + offset
            else:
                value = values[name] = float(random.normal())
        elif kind != "fixed":
            value = values[name] = random.normal(size=6 if kind == "floating" else 3)
        local = pose(xyz, euler(*rpy)) @ moved(kind, unit, value)
        poses[f"l{number}"] = poses[f"l{parent}"] @ local
        parts.append(
            f'<joint name="{name}" type="{kind}"><parent link="l{parent}"/>'
            f'<child link="l{number}"/><origin xyz="{words(xyz)}" rpy="{words(rpy)}"/>'
            f'<axis xyz="{words(axis)}"/><limit lower="-9" upper="9"/>{mimic}</joint>'
        )
        form[name] = kind
    random.shuffle(parts)
    return Built("<robot name='it'>" + "\n".join(parts) + "</robot>", values, poses)
