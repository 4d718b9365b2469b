"""Joints: how a value moves a link against its parent.

In: the kind of a joint, its axis, its limits, and values. Out: poses, by single operations in a
fixed order. Angles are radians, lengths metres. Source: http://wiki.ros.org/urdf/XML/joint.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ...base import linalg
from ...base.angles import Angle
from ...base.near_words import meant
from ...base.numbers import floats, shown
from ...choices import JointKind
from ...errors import InvalidArgumentError, warn

#: What a joint holds: a number, (3,) of a planar or spherical one, a (4, 4) pose of a floating one.
JointValue: TypeAlias = "float | NDArray[np.float64]"

_NUMBERS = {
    "planar": "three numbers: x, y and an angle",
    "spherical": "three numbers: roll, pitch, yaw",
    "floating": "six numbers: x, y, z, roll, pitch, yaw; or a (4, 4) pose",
}
#: How many of a value's numbers are metres; those after them are radians.
_LENGTHS = {"prismatic": 1, "planar": 2, "floating": 3}


class JointForm(NamedTuple):
    """What is constant about a joint.

    Attributes
    ----------
    name : str
    kind : JointKind
    origin : (4, 4) float64
        parent-from-child at value 0.
    axis : tuple of 3 float
        Unit vector in the child link.
    limits : (float, float) or None
        Least and greatest value.
    mimic : (str, float, float) or None
        The joint that it follows, a factor and an offset: ``value = factor * other + offset``.
    """

    name: str
    kind: JointKind
    origin: NDArray[np.float64]
    axis: tuple[float, ...]
    limits: tuple[float, float] | None = None
    mimic: tuple[str, float, float] | None = None

    @property
    def is_single(self) -> bool:
        """Whether one number moves the joint."""
        return self.kind in ("revolute", "continuous", "prismatic")


def rest_value(form: JointForm) -> JointValue:
    """Return the value 0 of a joint's kind."""
    if form.kind == "floating":
        return frozen(np.eye(4))
    return frozen(np.zeros(3)) if form.kind in ("planar", "spherical") else 0.0


def turned(roll: float, pitch: float, yaw: float) -> NDArray[np.float64]:
    """Return a rotation about the fixed axes x, then y, then z, (4, 4) float64."""
    first = linalg.multiply(linalg.rotation_y(pitch), linalg.rotation_x(roll))
    return linalg.multiply(linalg.rotation_z(yaw), first)


def joint_pose(form: JointForm, value: JointValue) -> NDArray[np.float64]:
    """Return parent-from-child of a joint at a checked value, (4, 4) float64.

    A planar joint moves along x and y of a frame whose z is the axis, the shorter way round from z,
    then turns about the axis.
    """
    return linalg.multiply(form.origin, _motion(form, value))


def _motion(form: JointForm, value: Any) -> NDArray[np.float64]:
    if form.kind == "fixed":
        return np.eye(4)
    if form.kind == "floating":
        return value
    if form.kind == "spherical":
        return turned(*np.asarray(value).tolist())
    if form.kind == "planar":
        x, y, angle = np.asarray(value).tolist()
        across, along = _plane(form.axis)
        moved = linalg.translation(x * across + y * along)
        return linalg.multiply(moved, linalg.rotation_axis(form.axis, angle))
    if form.kind == "prismatic":
        return linalg.translation(np.array(form.axis) * value)
    return linalg.rotation_axis(form.axis, value)


def _plane(axis: tuple[float, ...]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return x and y turned the shorter way round so that z becomes the axis."""
    a, b, c = axis
    if c < -1.0 + 1e-12:
        return np.array([1.0, 0.0, 0.0]), np.array([0.0, -1.0, 0.0])
    k = 1.0 / (1.0 + c)
    return np.array([1.0 - a * a * k, -a * b * k, -a]), np.array([-a * b * k, 1.0 - b * b * k, -b])


def checked_values(
    forms: Mapping[str, JointForm], values: Mapping[str, Any], *, clamp: bool = True
) -> dict[str, JointValue]:
    """Return the values of the named joints, and of those that follow them.

    Parameters
    ----------
    forms : mapping of str to JointForm
        All joints of a robot.
    values : mapping of str to value
    clamp : bool
        Hold values within limits, with a warning that names each; otherwise limits do not count.

    Raises
    ------
    InvalidArgumentError
        A name is unknown, a joint is fixed or follows another, or a value has a wrong form.
    """
    if not isinstance(values, Mapping):
        raise InvalidArgumentError(
            f"joints must be a dict of names and values, not {shown(values)}"
        )
    found: dict[str, JointValue] = {}
    for name, value in values.items():
        form = forms.get(name) if isinstance(name, str) else None
        if form is None:
            raise InvalidArgumentError(_no_joint(forms, name))
        if form.mimic is not None:
            raise InvalidArgumentError(f"joint {name!r} follows {form.mimic[0]!r}: move that one")
        found[name] = _checked(form, value)
    if clamp:
        found = {name: _within(forms[name], value) for name, value in found.items()}
    for form in forms.values():
        chain = _followed(forms, form)
        if chain is not None and chain[0] in found:
            found[form.name] = _following(found[chain[0]], *chain[1:])
    return found


def _no_joint(forms: Mapping[str, JointForm], name: object) -> str:
    movable = [form.name for form in forms.values() if form.kind != "fixed" and not form.mimic]
    hint = meant(name, movable) if isinstance(name, str) else ""
    known = ", ".join(movable[:40]) + (", …" if len(movable) > 40 else "")
    return f"there is no joint {shown(name)}{hint} (joints that move: {known or 'none'})"


def _checked(form: JointForm, value: ArrayLike) -> JointValue:
    if form.kind == "fixed":
        raise InvalidArgumentError(f"joint {form.name!r} is fixed")
    numbers = floats(value, f"position (the value of joint {form.name!r})")
    if not np.isfinite(numbers).all():
        raise InvalidArgumentError(f"joint {form.name!r} takes finite numbers, not {shown(value)}")
    given = value if isinstance(value, tuple) else (value,)
    for one in given[: _LENGTHS.get(form.kind, 0)]:
        if isinstance(one, Angle):
            raise InvalidArgumentError(
                f"joint {form.name!r} is {form.kind}: it moves by metres, not by {one:.4g} rad"
            )
    if form.is_single and numbers.shape in ((), (1,)):
        return float(numbers.reshape(()))
    if form.kind in ("planar", "spherical") and numbers.shape == (3,):
        return frozen(numbers.astype(np.float64))
    if form.kind == "floating" and numbers.shape == (4, 4):
        return frozen(numbers.astype(np.float64))
    if form.kind == "floating" and numbers.shape == (6,):
        moved = linalg.translation(numbers[:3])
        return frozen(linalg.multiply(moved, turned(*numbers[3:].tolist())))
    raise InvalidArgumentError(
        f"joint {form.name!r} takes {_NUMBERS.get(form.kind, 'one number')}, not {shown(value)}"
    )


def _within(form: JointForm, value: JointValue) -> JointValue:
    if form.limits is None or not isinstance(value, float):
        return value
    low, high = form.limits
    held = min(max(value, low), high)
    if held != value:
        unit = "m" if form.kind == "prismatic" else "rad"
        warn(
            f"joint {form.name!r}: {value:g} {unit} is beyond its limits {low:g} to {high:g}; "
            f"it stands at {held:g}"
        )
    return held


def _followed(forms: Mapping[str, JointForm], form: JointForm) -> tuple[str, float, float] | None:
    """Return the joint that one follows in the end, with the factor and offset of all steps."""
    if form.mimic is None:
        return None
    name, factor, offset = form.mimic
    while (mimic := forms[name].mimic) is not None:
        name, factor, offset = mimic[0], factor * mimic[1], factor * mimic[2] + offset
    return name, factor, offset


def _following(value: JointValue, factor: float, offset: float) -> JointValue:
    return factor * value + offset
