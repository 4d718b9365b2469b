"""The joints of a URDF file, and the tree that they make of its links.

In: a `UrdfText` and its links. Out: joints, and the roots. A link below itself or below two others
is an error; several roots are a warning.
"""

from __future__ import annotations

from typing import NamedTuple, get_args

from ....base import linalg
from ....base.near_words import meant
from ....choices import JointKind
from ....model.motion.joints import JointForm
from ...reading.text import shown
from ...reading.xml_elements import Element
from .urdf_elements import UrdfText
from .urdf_model import Link, pose_of

KINDS: tuple[JointKind, ...] = get_args(JointKind)
_ZERO = (0.0,)
_X_AXIS = (1.0, 0.0, 0.0)


class UrdfJoint(NamedTuple):
    """A joint between two links.

    Attributes
    ----------
    form : JointForm
    parent, child : str
        Names of links.
    line : int
    """

    form: JointForm
    parent: str
    child: str
    line: int

    @property
    def name(self) -> str:
        return self.form.name


def read_joints(text: UrdfText, links: dict[str, Link]) -> dict[str, UrdfJoint]:
    """Return the joints by name.

    Raises
    ------
    FileFormatError
        A name is missing, unknown or given twice, a number is wrong, or links form no tree.
    """
    joints: dict[str, UrdfJoint] = {}
    above: dict[str, UrdfJoint] = {}
    for element in text.root.all("joint"):
        joint = _joint(text, element, links)
        if joint.name in joints:
            first = joints[joint.name].line
            raise text.fault(f"joint {shown(joint.name)} is in line {first} already", element)
        if joint.child in above:
            other = above[joint.child]
            raise text.fault(
                f"link {shown(joint.child)} has two parents: joint {shown(other.name)} of line "
                f"{other.line} moves it, too",
                element,
            )
        joints[joint.name] = above[joint.child] = joint
    _check_tree(text, links, above)
    _check_mimics(text, joints)
    return joints


def roots_of(text: UrdfText, links: dict[str, Link], joints: dict[str, UrdfJoint]) -> list[str]:
    """Return the links without a parent, with a warning if there are several."""
    below = {joint.child for joint in joints.values()}
    roots = [name for name in links if name not in below]
    if len(roots) > 1:
        names = ", ".join(map(shown, roots))
        text.warn(f"{len(roots)} links have no parent: {names}; all stand at the origin", text.root)
    return roots


def _joint(text: UrdfText, element: Element, links: dict[str, Link]) -> UrdfJoint:
    name, given = text.name(element), text.name(element, "type")
    kind = next((known for known in KINDS if known == given), None)
    if kind is None:
        hint = meant(given, KINDS)
        text.warn(f"joint {shown(name)} has type {shown(given)}{hint}; it is fixed", element)
        kind = "fixed"
    axis = text.numbers(element.first("axis"), "xyz", _X_AXIS)
    if not any(axis) and kind not in ("fixed", "floating", "spherical"):
        text.warn(f"the axis of joint {shown(name)} has no length; it is fixed", element)
        kind = "fixed"
    form = JointForm(
        name,
        kind,
        pose_of(text, element.first("origin")),
        tuple(linalg.normalize(axis).tolist()) if any(axis) else _X_AXIS,
        _limits(text, element, kind),
        _mimic(text, element),
    )
    parent, child = (_link(text, element, end, links) for end in ("parent", "child"))
    return UrdfJoint(form, parent, child, element.line)


def _link(text: UrdfText, element: Element, end: str, links: dict[str, Link]) -> str:
    inner = element.first(end)
    if inner is None:
        raise text.fault(f"<joint> needs <{end}>", element)
    name = text.name(inner, "link")
    if name not in links:
        text.unknown("link", name, links, inner)
    return name


def _limits(text: UrdfText, element: Element, kind: JointKind) -> tuple[float, float] | None:
    if kind not in ("revolute", "prismatic"):
        return None
    limit = element.first("limit")
    if limit is None:
        text.warn(f"a {kind} joint without <limit> moves without limits", element)
        return None
    (low,), (high,) = (text.numbers(limit, end, _ZERO) for end in ("lower", "upper"))
    if low > high:
        text.warn(f"lower limit {low:g} is above upper limit {high:g}: none counts", limit)
        return None
    return low, high


def _mimic(text: UrdfText, element: Element) -> tuple[str, float, float] | None:
    mimic = element.first("mimic")
    if mimic is None:
        return None
    (factor,) = text.numbers(mimic, "multiplier", (1.0,))
    (offset,) = text.numbers(mimic, "offset", _ZERO)
    return text.name(mimic, "joint"), factor, offset


def _check_tree(text: UrdfText, links: dict[str, Link], above: dict[str, UrdfJoint]) -> None:
    """Raise if a link is below itself."""
    sound: set[str] = set()
    for name in links:
        path: dict[str, UrdfJoint] = {}
        while name in above and name not in sound:
            joint = above[name]
            if name in path:
                around = ", ".join(f"{shown(one.name)} (line {one.line})" for one in path.values())
                where = Element("joint", {}, joint.line)
                raise text.fault(f"link {shown(name)} is below itself: joints {around}", where)
            path[name] = joint
            name = joint.parent
        sound.update(path)


def _check_mimics(text: UrdfText, joints: dict[str, UrdfJoint]) -> None:
    """Raise if a joint follows one that is unknown, or itself."""
    for joint in joints.values():
        seen, here = {joint.name}, joint
        where = Element("joint", {}, joint.line)
        while here.form.mimic is not None:
            followed = here.form.mimic[0]
            if followed not in joints:
                text.unknown("joint", followed, joints, where)
            if followed in seen:
                raise text.fault(f"joint {shown(joint.name)} follows itself", where)
            seen.add(followed)
            here = joints[followed]
