"""What data sets write of a picture: outputs of frames, stereo pairs and optical flow, as files.

In: a sample, and names such as ``"depth"``, ``"disparity.png"`` or ``"forward_flow.flo"``. Out: the
bytes of their files, with what is not valid marked as the format marks it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import shown
from ...base.validation import choose
from ...errors import InvalidArgumentError
from ...extras.sensors.moments import Moment
from ...extras.sensors.stereo import StereoCamera, stereo_pair
from ...io.output.value_files import MARKS, encode_values
from ...rendering.frame import OUTPUTS, Frame, Output
from .samples import Move, Sample

#: An array, and which of its pixels are valid; None: all, or as its own zeros say.
Values: TypeAlias = tuple[NDArray[Any], NDArray[np.bool_] | None]
_FLOW, _MASK = np.zeros((1, 1, 2), np.float32), np.zeros((1, 1), np.bool_)
_LENGTH, _COLOR = np.zeros((1, 1), np.float32), np.zeros((1, 1, 4), np.uint8)


class _Row(NamedTuple):
    """What is measured besides the outputs of frames: its like, what it needs, what it is."""

    like: NDArray[Any]
    needs: str  # right, next or previous
    says: str


_MEASURED = {
    "right_color": _Row(_COLOR, "right", "the picture of the right camera; color is the left's"),
    "disparity": _Row(
        _LENGTH, "right", "pixels by which the left picture's points are farther left in the right"
    ),
    "disparity_visible": _Row(_MASK, "right", "where the right picture shows the same point"),
    "right_disparity": _Row(
        _LENGTH, "right", "pixels by which the right picture's points are farther right in the left"
    ),
    "right_disparity_visible": _Row(_MASK, "right", "where the left picture shows the same point"),
    "next_color": _Row(_COLOR, "next", "the next picture"),
    "forward_flow": _Row(
        _FLOW, "next", "pixels to the right and down that each point moves to the next picture"
    ),
    "forward_visible": _Row(_MASK, "next", "where the next picture shows the same point"),
    "previous_color": _Row(_COLOR, "previous", "the picture before"),
    "backward_flow": _Row(
        _FLOW, "previous", "pixels to the right and down from each point to where it was before"
    ),
    "backward_visible": _Row(_MASK, "previous", "where the picture before shows the same point"),
}
#: All that a data set may hold of a picture.
NAMES = (*OUTPUTS, *_MEASURED)


def checked_outputs(outputs: Sequence[str], baseline: float | None) -> tuple[str, ...]:
    """Return names of outputs with formats, checked, each with its suffix.

    Raises
    ------
    InvalidArgumentError
    """
    if isinstance(outputs, str) or not isinstance(outputs, Sequence):
        raise InvalidArgumentError(f"outputs must be names of outputs, not {shown(outputs)}")
    found: dict[str, str] = {}
    for given in outputs:
        name, _, suffix = str(given).partition(".")
        choose(name, NAMES, "outputs")
        if name in found:
            raise InvalidArgumentError(f"outputs must name {name} once")
        if name in _MEASURED and _MEASURED[name].needs == "right" and baseline is None:
            raise InvalidArgumentError(
                f"outputs must be without {name}, or baseline must be given: the distance of the "
                "right camera"
            )
        found[name] = f"{name}.{_checked_suffix(name, suffix)}"
    if not found:
        raise InvalidArgumentError('outputs must name at least one output, such as "color"')
    return tuple(found.values())


def _checked_suffix(name: str, suffix: str) -> str:
    like = _like(name)
    if like.dtype == np.uint8:
        return choose(suffix or "png", ("png",), f"outputs: the format of {name}")
    if not suffix:
        return "png" if like.dtype == np.bool_ else "npy"
    choose(suffix, MARKS, f"outputs: the format of {name}")
    try:
        encode_values(like, suffix)
    except InvalidArgumentError as error:
        raise InvalidArgumentError(f"outputs: {name}: {error}") from None
    return suffix


def _like(name: str) -> NDArray[Any]:
    """Return an array of the dtype and channels of an output."""
    if name in _MEASURED:
        return _MEASURED[name].like
    dtype, channels = OUTPUTS[name]
    return np.zeros((1, 1, channels) if channels else (1, 1), dtype)


def frame_outputs(written: Sequence[str]) -> tuple[Output, ...]:
    """Return the outputs that frames must hold for what is written."""
    names: list[str] = []
    for one in written:
        name = one.partition(".")[0]
        if name not in _MEASURED:
            names.append(name)
        else:
            names += ["depth"] if _MEASURED[name].needs == "right" else []
            names += Moment.OUTPUTS
    return cast("tuple[Output, ...]", tuple(dict.fromkeys(names)))


def described(written: Sequence[str]) -> Iterator[str]:
    """Yield a line for each output that is written: its name, what it is, how it is marked."""
    for one in written:
        name, _, suffix = one.partition(".")
        says = _MEASURED[name].says if name in _MEASURED else getattr(Frame, name).__doc__
        mark = "" if suffix == "png" and _like(name).dtype == np.uint8 else f" {MARKS[suffix]}"
        raw = suffix == "npy" and name not in _MEASURED
        yield f"{name} (.{suffix}): {says.rstrip('.')}.{'' if raw else mark}"


def encoded(
    sample: Sample, written: Sequence[str], baseline: float | None
) -> Iterator[tuple[str, str, bytes]]:
    """Yield name, suffix and bytes of each output of a sample. The scene may then have moved."""
    names = [one.partition(".")[0] for one in written]
    found = _measured(sample, names, baseline)
    for one, name in zip(written, names, strict=True):
        suffix = one.partition(".")[2]
        values, valid = found[name]() if name in found else _of_frame(sample.frame, name, suffix)
        yield name, suffix, _bytes_of(values, suffix, valid)


def encoded_output(frame: Frame, one: str) -> tuple[str, bytes]:
    """Return suffix and bytes of one of a frame's own outputs, such as ``"depth.pfm"``."""
    name, _, suffix = one.partition(".")
    suffix = suffix or _checked_suffix(name, "")
    values, valid = _of_frame(frame, name, suffix)
    return suffix, _bytes_of(values, suffix, valid)


def _bytes_of(values: NDArray[Any], suffix: str, valid: NDArray[np.bool_] | None) -> bytes:
    if values.dtype == np.uint8:
        return Frame((values.shape[1], values.shape[0]), {"color": values}).encode("png")
    return encode_values(values, suffix, valid=valid)


def _of_frame(frame: Frame, name: str, suffix: str) -> Values:
    """Return an output of a frame; NumPy's files have it as it is."""
    values: NDArray[Any] = getattr(frame, name)
    return values, values > 0 if name in ("depth", "range") and suffix != "npy" else None


def _measured(
    sample: Sample, names: Sequence[str], baseline: float | None
) -> dict[str, Callable[[], Values]]:
    """Measure what is needed: what stands still first, since the scene moves for the others."""
    needed = {_MEASURED[name].needs for name in names if name in _MEASURED}
    if not needed:
        return {}
    now = Moment(sample.frame, sample.scene)
    found: dict[str, Callable[[], Values]] = {}
    if "right" in needed and baseline is not None:
        found |= _stereo(sample, now, StereoCamera(sample.camera, baseline))
    for need, way, move in (
        ("next", "forward", sample.to_next),
        ("previous", "backward", sample.to_previous),
    ):
        if need in needed:
            found |= _flow(sample, now, need, way, move)
    return found


def _stereo(sample: Sample, now: Moment, stereo: StereoCamera) -> dict[str, Callable[[], Values]]:
    right = _drawn(sample, (sample.camera, stereo.right_pose(sample.pose)), ("color", "depth"))
    pair = stereo_pair(stereo, now, right)
    left, other = pair.left_disparity, pair.right_disparity
    return {
        "right_color": lambda: (pair.right.color, None),
        "disparity": lambda: (left, left > 0),
        "disparity_visible": lambda: (pair.left_visible, None),
        "right_disparity": lambda: (other, other > 0),
        "right_disparity_visible": lambda: (pair.right_visible, None),
    }


def _flow(
    sample: Sample, now: Moment, need: str, way: str, move: Move | None
) -> dict[str, Callable[[], Values]]:
    if move is None:
        raise InvalidArgumentError(
            f"{way}_flow, {way}_visible and {need}_color need the {need} moment: a function "
            f"to_{need} of the sample, or {need!r} of what a script returns"
        )
    there = _drawn(sample, move() or (sample.camera, sample.pose), ("color",))
    flow = now.flow_to(there)
    return {
        f"{need}_color": lambda: (there.frame.color, None),
        f"{way}_flow": lambda: (flow.vectors, flow.known),
        f"{way}_visible": lambda: (flow.visible, None),
    }


def _drawn(sample: Sample, camera: Any, outputs: tuple[Output, ...]) -> Moment:
    """Draw the sample's scene as it is now, as the sample was drawn."""
    options = replace(sample.options, outputs=(*outputs, *Moment.OUTPUTS))
    return Moment(sample.renderer.render(sample.scene, camera, options=options), sample.scene)
