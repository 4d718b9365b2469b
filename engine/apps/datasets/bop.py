"""The BOP data set format: RGB, depth, masks, and the pose of each thing.

Out: ``SPLIT/SCENE/rgb/IMAGE.png``, ``depth`` of 16 bits, ``mask`` and ``mask_visib``, one for each
thing, and for each scene ``scene_camera.json``, ``scene_gt.json`` and ``scene_gt_info.json``;
``camera.json``, and ``models`` where all things of a category have one shape (`bop_models`);
``README.txt``.
Cameras look along +Z with +Y down, lengths are millimetres, the centre of the top left pixel is
(0, 0). A thing's mask is what it would show alone; counts and boxes of its silhouette reach beyond
the picture, to three times its size. Widths of boxes are, as bop_toolkit has them, the distance of
the outermost pixels; boxes of what does not show are four times -1.
Source: docs/bop_datasets_format.md and scripts/calc_gt_info.py of bop_toolkit, written anew; what
is visible is exact here, and needs no tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.calls import checks_types
from ...base.files import json_records as records
from ...base.files.png import encode_pixels
from ...base.numbers import shown
from ...base.validation import positive
from ...errors import InvalidArgumentError
from .bop_models import has_shapes, shape_name, shape_of, write_models
from .bop_symmetries import checked_symmetries
from .opencv_cameras import cv_from_camera, intrinsics_of, rigid_parts
from .readme import write_readme
from .samples import Sample, Thing, box_of
from .silhouettes import Silhouette, silhouette_of
from .writer import (
    Content,
    DatasetWriter,
    JsonParts,
    Note,
    category_numbers,
    check_category,
    checked_categories,
    compact,
)

_DEEPEST = 65535
_NOWHERE = [-1, -1, -1, -1]
_ROTATION, _PLACE = records.listed(records.number, 9), records.listed(records.number, 3)
_BOX = records.listed(records.whole, 4)
_CAMERA = {
    "cam_K": records.listed(records.number, 9),
    "depth_scale": records.number,
    "cam_R_w2c": _ROTATION,
    "cam_t_w2c": _PLACE,
}
_INFO = {
    "bbox_obj": _BOX,
    "bbox_visib": _BOX,
    "px_count_all": records.count,
    "px_count_valid": records.count,
    "px_count_visib": records.count,
    "visib_fract": records.number,
}
_NOTE = records.members(
    {
        "camera": records.members(_CAMERA),
        "size": records.row(records.count, records.count),
        "shapes": records.listed(records.maybe(shape_name)),
        "truth": records.listed(records.row(records.sound_text, _ROTATION, _PLACE)),
        "info": records.listed(records.members(_INFO)),
    }
)


def _note_shape(value: Any) -> str | None:
    """Return the shape of a picture's note: as many shapes as poses and counts."""
    where = _NOTE(value)
    if where is None and len({len(value[key]) for key in ("shapes", "truth", "info")}) > 1:
        return ""
    return where


class BopWriter(DatasetWriter):
    """Writes pictures, depths, masks and poses in BOP format.

    Parameters
    ----------
    split : str
        The folder of the scenes, such as ``"train_pbr"``.
    categories : sequence of str, optional
        The objects, in the order of their ``obj_id`` from 1 on; others are errors. Left out, they
        are those that the pictures have, sorted by name.
    scene_size : int
        Pictures in a scene's folder.
    depth_scale : float
        Millimetres of one step of the depth pictures, which reach to 65,535 steps.
    millimetres : float
        How long the scene's own unit is; 1000 where scenes are in metres.
    symmetries : mapping of str to mapping, optional
        Of categories, in the words of models_info.json: ``symmetries_discrete``, a list of 4x4
        matrices of 16 numbers, row by row, and ``symmetries_continuous``, a list of objects with an
        ``axis`` and an ``offset``, three numbers each; in millimetres and the model's coordinates.

    Raises
    ------
    InvalidArgumentError
    """

    kind = "bop"
    outputs = ("color", "depth", "object_id")
    note_shape = staticmethod(_note_shape)

    def __init__(
        self,
        split: str = "train",
        categories: Sequence[str] | None = None,
        scene_size: int = 1000,
        depth_scale: float = 1.0,
        millimetres: float = 1000.0,
        symmetries: Mapping[str, Mapping[str, Any]] | None = None,
    ) -> None:
        if not (isinstance(split, str) and split.isidentifier()):
            raise InvalidArgumentError(f"split must be a name like train_pbr, not {shown(split)}")
        if isinstance(scene_size, bool) or not isinstance(scene_size, int) or scene_size < 1:
            raise InvalidArgumentError(f"scene_size must be above 0, not {shown(scene_size)}")
        self.split = split
        self.categories = checked_categories(categories)
        self.scene_size = scene_size
        self.depth_scale = positive(depth_scale, "depth_scale")
        self.millimetres = positive(millimetres, "millimetres")
        self.symmetries = checked_symmetries({} if symmetries is None else symmetries)
        for category in self.symmetries:
            check_category(self.categories, category)

    @checks_types
    def describe(self, sample: Sample) -> tuple[dict[str, Content], Any]:
        folder, image = self._place(sample.index)
        depth = sample.frame.depth
        files: dict[str, Content] = {
            f"{folder}/rgb/{image:06d}.png": encode_pixels(sample.frame.color[..., :3]),
            f"{folder}/depth/{image:06d}.png": encode_pixels(self._steps(depth)),
        }
        truth, info, shapes = [], [], []
        for number, thing in enumerate(sample.things()):
            check_category(self.categories, thing.category)
            truth.append([thing.category, *self._pose(thing, sample)])
            whole = silhouette_of(thing, sample)
            visible = thing.mask(sample.frame.object_id)
            info.append(_counts(whole, visible, depth))
            files[f"{folder}/mask/{image:06d}_{number:06d}.png"] = encode_pixels(whole.mask)
            files[f"{folder}/mask_visib/{image:06d}_{number:06d}.png"] = encode_pixels(visible)
            shape, files_of_shape = shape_of(thing, self.millimetres)
            shapes.append(shape)
            files.update(files_of_shape)
        size = [sample.frame.width, sample.frame.height]
        said = {"camera": self._camera(sample), "size": size, "shapes": shapes}
        return files, {**said, "truth": truth, "info": info}

    @checks_types
    def is_whole(self, folder: str, note: Note) -> bool:
        return has_shapes(folder, note.said["shapes"])

    @checks_types
    def finish(self, folder: str, notes: Iterable[Note]) -> Iterator[str]:
        found = (category for note in notes for category, *_ in note.said["truth"])
        numbers = category_numbers(self.categories, found)
        for _, group in groupby(notes, key=lambda note: note.index // self.scene_size):
            scene = list(group)
            for name, values in (
                ("scene_camera", ((note, note.said["camera"]) for note in scene)),
                ("scene_gt", ((note, _truth(note, numbers)) for note in scene)),
                ("scene_gt_info", ((note, note.said["info"]) for note in scene)),
            ):
                path = f"{self._place(scene[0].index)[0]}/{name}.json"
                with JsonParts(folder, path) as parts:
                    keyed = ((str(self._place(note.index)[1]), value) for note, value in values)
                    parts.all(keyed, "{}", keys=True)
                    parts.text("\n")
                yield path
        yield from _camera_file(folder, notes)
        shapes = (
            (category, shape)
            for note in notes
            for (category, *_), shape in zip(note.said["truth"], note.said["shapes"], strict=True)
        )
        yield from write_models(folder, numbers, shapes, self.symmetries)
        yield write_readme(folder, self._says())

    def _says(self) -> Iterator[str]:
        """Yield what the README says."""
        yield "The format of the BOP benchmark, bop.felk.cvut.cz: lengths are in millimetres;"
        yield "cameras look along +Z with +Y down; the centre of the top left pixel is (0, 0)."
        yield f"{self.split}/SCENE/depth: depth along the camera's axis in steps of"
        yield f"{self.depth_scale!r} mm (depth_scale of scene_camera.json); 0 = background."
        yield "models, models_eval: the same shapes. models_info.json: diameters, boxes,"
        yield "symmetries as they were told."

    def _place(self, index: int) -> tuple[str, int]:
        """Return the folder of a picture's scene, and its number there."""
        scene, image = divmod(index, self.scene_size)
        return f"{self.split}/{scene:06d}", image

    def _steps(self, depth: NDArray[np.float32]) -> NDArray[np.uint16]:
        """Return depths in whole steps, rounded half up; 0 for background."""
        steps = np.floor(depth.astype(np.float64) * (self.millimetres / self.depth_scale) + 0.5)
        if steps.max(initial=0.0) > _DEEPEST:
            farthest = float(depth.max()) * self.millimetres
            raise InvalidArgumentError(
                f"depths of up to {farthest:g} mm do not fit 16 bits with depth_scale "
                f"{self.depth_scale:g}: {_round_above(1.5 * farthest / _DEEPEST):g} is enough"
            )
        return steps.astype(np.uint16)

    def _pose(self, thing: Thing, sample: Sample) -> tuple[list[float], list[float]]:
        """Return a thing's rotation, row by row, and position, in camera space."""
        from_model = linalg.multiply(cv_from_camera(sample.pose), thing.node.world_pose)
        return rigid_parts(from_model, self.millimetres, f"{thing.node.name!r}")

    def _camera(self, sample: Sample) -> dict[str, Any]:
        rotation, place = rigid_parts(cv_from_camera(sample.pose), self.millimetres, "the camera")
        return {
            "cam_K": intrinsics_of(sample.camera, sample.frame.width, sample.frame.height),
            "depth_scale": self.depth_scale,
            "cam_R_w2c": rotation,
            "cam_t_w2c": place,
        }


def _camera_file(folder: str, notes: Iterable[Note]) -> Iterator[str]:
    """Write the data set's camera file, for its first picture's camera."""
    for note in notes:
        (fx, _, cx, _, fy, cy, *_), (width, height) = (
            note.said["camera"]["cam_K"],
            note.said["size"],
        )
        said = {"cx": cx, "cy": cy, "depth_scale": note.said["camera"]["depth_scale"]}
        said |= {"fx": fx, "fy": fy, "height": height, "width": width}
        with JsonParts(folder, "camera.json") as parts:
            parts.text(f"{compact(said)}\n")
        yield "camera.json"
        return


def _round_above(value: float) -> float:
    """Return the next of 1, 2, 5, 10, 20 … above a value: equal for most pictures of a scene."""
    unit = 10.0 ** math.floor(math.log10(value))
    return unit * next(step for step in (1, 2, 5, 10) if unit * step >= value)


def _truth(note: Note, numbers: dict[str, int]) -> list[dict[str, Any]]:
    return [
        {"cam_R_m2c": rotation, "cam_t_m2c": place, "obj_id": numbers[category]}
        for category, rotation, place in note.said["truth"]
    ]


def _counts(
    whole: Silhouette, visible: NDArray[np.bool_], depth: NDArray[np.float32]
) -> dict[str, Any]:
    """Return a thing's entry of scene_gt_info.json."""
    shows = int(visible.sum())
    return {
        "bbox_obj": _as_toolkit(whole.box) if shows else _NOWHERE,
        "bbox_visib": _as_toolkit(box_of(visible)) if shows else _NOWHERE,
        "px_count_all": whole.count,
        "px_count_valid": int((whole.mask & (depth > 0)).sum()),
        "px_count_visib": shows,
        "visib_fract": shows / whole.count if whole.count else 0.0,
    }


def _as_toolkit(box: tuple[int, int, int, int]) -> list[int]:
    x, y, width, height = box
    return [x, y, width - 1, height - 1]
