"""An MjvScene, as the core reads it: geoms, lights, the camera.

In: a scene that `mjv_updateScene` has filled. Out: records and numbers for `NativePicture.render`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..._native.mujoco import GEOM, LIGHT, LIGHTS
from ...base.linalg.trigonometry import cos, tan
from ...errors import InvalidArgumentError, warn
from ._layouts import view_geoms, view_lights
from ._model import Model

_GEOM = 5  # of mjtObj
_FLEX_TYPE = 105  # of mjtGeom
_SPOT, _DIRECTIONAL = 0, 1  # of mjtLightType
_LEAST_NEAR = 1e-15  # mjMINVAL
_AS_THEY_ARE = (
    *("type", "dataid", "objid", "category", "matid", "segid", "size", "pos", "mat", "rgba"),
    *("emission", "specular", "shininess", "reflectance", "texcoord", "modelrbound"),
    *("texid", "texuniform", "texrepeat"),  # of versions whose geoms have them
)
_OTHER_NAMES = {"modelrbound": "rbound"}
# What is found of these fields of MuJoCo's geoms stays as long as they do, and the model
_DECIDING = (
    *("type", "objtype", "dataid", "objid", "matid", "texid", "texuniform", "texrepeat"),
    *("castshadow", "modelrbound"),
)
_FOUND = ("objid", "texid", "texuniform", "texrepeat", "castshadow", "rbound")


_Row = list[float]


class SceneView:
    """The memory of one scene, read in place.

    Attributes
    ----------
    scene : mujoco.MjvScene
    """

    def __init__(self, scene: Any) -> None:
        self.scene = scene
        self._geoms = view_geoms(scene)
        self._lights = view_lights(scene)
        self._words = _words(self._geoms)
        self._labels = self._geoms["label"]
        self._columns = _columns(self._geoms.dtype)
        self._deciding = _words_of(self._geoms.dtype, _DECIDING)
        self._found: tuple[Any, ...] = ()  # a model, what decided, and what was found
        self._lit: tuple[Any, ...] = ()  # what lights were last, and what was made of them

    def objects_of(self, numbers: np.ndarray) -> np.ndarray:
        """Return the objid and objtype of geoms, (..., 2) int32; of number -1 both are -1."""
        count = self.scene.ngeom
        table = np.full((count + 1, 2), -1, np.int32)
        table[:count, 0], table[:count, 1] = (
            self._geoms["objid"][:count],
            self._geoms["objtype"][:count],
        )
        pairs = table.view(np.int64)[:, 0].take(numbers, mode="wrap")  # a pair at a time
        return pairs.view(np.int32).reshape(*numbers.shape, 2)

    def segment_ids(self) -> np.ndarray:
        """Return the segid of each geom, (N,) int32."""
        return self._geoms["segid"][: self.scene.ngeom]

    def geoms(self, model: Model) -> np.ndarray:
        """Return the geoms as the core reads them."""
        words = self._words[: self.scene.ngeom]
        out = words.take(self._columns, axis=1)
        memory = model, words.take(self._deciding, axis=1).tobytes()
        if self._found[:-1] != memory:
            self._find_rest(model, out.view(GEOM)[:, 0])
            self._found = (*memory, out.take(_FOUND_WORDS, axis=1))
        out[:, _FOUND_WORDS] = self._found[-1]
        return out.view(GEOM)[:, 0]

    def _find_rest(self, model: Model, out: np.ndarray) -> None:
        """Set what geoms do not say as they are."""
        from_ = self._geoms[: len(out)]
        names = from_.dtype.names or ()
        out["castshadow"] = from_["castshadow"] if "castshadow" in names else 1
        out["rbound"][from_["objtype"] != _GEOM] = -1
        for i in np.flatnonzero(out["type"] == _FLEX_TYPE):
            out["objid"][i] = model.flex_part(int(out["objid"][i]), int(out["dataid"][i]))
        by_material = out["matid"] >= 0
        if "texid" in names:
            by_material &= out["texid"] < 0
        else:
            out["texid"], out["texuniform"], out["texrepeat"] = -1, 0, 0
        if len(model.texids) and by_material.any():
            chosen = np.minimum(out["matid"][by_material], len(model.texids) - 1)
            out["texid"][by_material] = model.texids[chosen]
            out["texuniform"][by_material] = model.texuniforms[chosen]
            out["texrepeat"][by_material] = model.texrepeats[chosen]

    def warn_of_labels(self) -> None:
        """Warn if a geom has a label, since text is not drawn."""
        if self._labels[: self.scene.ngeom].any():
            warn("labels of geoms are not drawn")

    def lights(self, model: Model, *, none: bool = False) -> tuple[np.ndarray, float]:
        """Return the lights as the core reads them, and the ambient light of scenes without any."""
        if none:
            return np.zeros(0, LIGHT), 0.0
        every = self._lights[: self.scene.nlight]
        quality = model.quality
        assert quality is not None
        memory = model, quality.shadow_clip, quality.shadow_scale, every.tobytes()
        if self._lit[:-1] == memory:
            return self._lit[-1]
        named = every.dtype.names or ()
        kind = every["type"] if "type" in named else every["directional"].astype(np.int32)
        supported = (kind == _DIRECTIONAL) | (kind == _SPOT)
        is_all = bool(supported.all())
        if not is_all:
            warn(
                "lights of the types point and image are not drawn, as in MuJoCo's classic renderer"
            )
        ambient = 0.0 if supported.any() else 0.3
        from_, kind = (each[:LIGHTS][supported[:LIGHTS]] for each in (every, kind))
        out = np.zeros(len(from_), LIGHT)
        for name in (
            "pos",
            "dir",
            "attenuation",
            "ambient",
            "diffuse",
            "specular",
            "exponent",
            "castshadow",
        ):
            out[name] = from_[name]
        out["is_directional"] = kind == _DIRECTIONAL
        for k, light in enumerate(from_):
            if kind[k] == _DIRECTIONAL:
                out["cutoff_cosine"][k], out["shadow_reach"][k] = -2.0, quality.shadow_clip
            else:
                cutoff = float(light["cutoff"])
                field = min(2 * cutoff * quality.shadow_scale, 160.0)
                out["cutoff_cosine"][k] = cos(math.radians(cutoff)) if cutoff < 180 else -2.0
                out["shadow_reach"][k] = max(tan(math.radians(field / 2)), 1e-9)
        self._lit = (*memory, (out, ambient)) if is_all else ()  # else the next picture warns, too
        return out, ambient

    def has_moving_shapes(self) -> bool:
        """Return whether there are skins or flexes."""
        return bool(self.scene.nskin or getattr(self.scene, "nflex", 0))

    def set_moving_shapes(self, model: Model) -> None:
        """Give the core the skins and flexes as they are now."""
        scene = self.scene
        for number in range(scene.nskin):
            faces, uvs = model.skins[number]
            begin = int(scene.skinvertadr[number])
            end = begin + int(scene.skinvertnum[number])
            positions = np.array(scene.skinvert.reshape(-1, 3)[begin:end], np.float32)
            normals = scene.skinnormal.reshape(-1, 3)[begin:end].astype(np.float32)[faces]
            edges = np.full(len(faces), 0b111, np.uint8)
            model.native.set_shape(model.first_skin + number, positions, faces, normals, uvs, edges)
        of_geom = self._geoms[: scene.ngeom]
        for geom in of_geom[of_geom["type"] == _FLEX_TYPE]:
            self._set_flex(model, geom)

    def _set_flex(self, model: Model, geom: np.void) -> None:
        """Give the core what a geom shows of a flex: its frame, and its faces.

        MuJoCo 4.0 has a geom for each material of a flex. Each says which faces are its own, and
        the first has the frame.
        """
        scene, number = self.scene, int(geom["objid"])
        part = model.flex_part(number, int(geom["dataid"]))
        if part < 0:
            return
        shape = model.first_flex + 2 * part
        used = int(scene.flexfaceused[number])
        if geom["dataid"] <= 0:
            hidden = bool(scene.flexskinopt) and used > 0
            radius = 0.0 if hidden else float(geom["size"][0])
            model.native.set_shape(shape, *_flex_frame(model, scene, number, radius))
        begin = int(scene.flexfaceadr[number])
        rows = slice(begin, begin + used)
        if geom["dataid"] >= 0:
            first, count = (max(int(share), 0) for share in geom["size"][1:])
            rows = slice(begin + min(first, used), begin + min(first + count, used))
        positions = np.array(scene.flexface.reshape(-1, 3, 3)[rows], np.float32)
        normals = np.array(scene.flexnormal.reshape(-1, 3, 3)[rows], np.float32)
        uvs = np.array(scene.flextexcoord.reshape(-1, 3, 2)[rows], np.float32)
        corners = np.arange(3 * len(positions), dtype=np.int32).reshape(-1, 3)
        edges = np.full(len(positions), 0b111, np.uint8)
        model.native.set_shape(shape + 1, positions.reshape(-1, 3), corners, normals, uvs, edges)


def _words(records: np.ndarray) -> np.ndarray:
    """Return the memory of records as words of 4 bytes, a row each."""
    return records.view(np.int32).reshape(len(records), records.dtype.itemsize // 4)


def _words_of(dtype: np.dtype, names: tuple[str, ...]) -> np.ndarray:
    """Return the numbers of the words that hold those fields of a record that it has."""
    fields = [dtype.fields[name][:2] for name in names if name in (dtype.names or ())]
    return np.concatenate(
        [offset // 4 + np.arange(-(-kind.itemsize // 4)) for kind, offset in fields]
    )


_FOUND_WORDS = _words_of(GEOM, _FOUND)


def _columns(dtype: np.dtype) -> np.ndarray:
    """Return the word of MuJoCo's geoms that is each word of the core's.

    Words that are not taken as they are have 0.
    """
    out = np.zeros(GEOM.itemsize // 4, np.int64)
    for name in set(_AS_THEY_ARE) & set(dtype.names or ()):
        kind, to = GEOM.fields[_OTHER_NAMES.get(name, name)][:2]
        words = np.arange(kind.itemsize // 4)
        out[to // 4 + words] = dtype.fields[name][1] // 4 + words
    return out


def _flex_frame(model: Model, scene: Any, number: int, radius: float) -> tuple:
    """Return the spheres at a flex's vertices and the cylinders along its edges."""
    at: list[np.ndarray] = [np.zeros((0, 3, 3))]
    normals: list[np.ndarray] = [np.zeros((0, 3, 3))]
    edges: list[np.ndarray] = [np.zeros(0, np.uint8)]
    begin, count = int(scene.flexvertadr[number]), int(scene.flexvertnum[number])
    vertices = scene.flexvert.reshape(-1, 3)[begin : begin + count].astype(np.float64)
    if radius > 0 and scene.flexvertopt:
        shape = model.unit_sphere
        at.append((vertices[:, None, None] + shape.at * radius).reshape(-1, 3, 3))
        normals.append(np.tile(shape.normals, (count, 1, 1)))
        edges.append(np.tile(shape.edges, count))
    if radius > 0 and scene.flexedgeopt:
        first = int(scene.flexedgeadr[number])
        pairs = scene.flexedge.reshape(-1, 2)[first : first + int(scene.flexedgenum[number])]
        shape = model.open_cylinder
        a, b = vertices[pairs[:, 0]], vertices[pairs[:, 1]]
        turns = _turns(b - a)
        half = np.sqrt(_dot(b - a, b - a)) / 2
        local = shape.at * [radius, radius, 1.0]
        moved = np.repeat(local[None], len(pairs), axis=0)
        moved[..., 2] *= half[:, None, None]
        at.append((_turned(turns, moved) + ((a + b) / 2)[:, None, None]).reshape(-1, 3, 3))
        tiled = np.repeat(shape.normals[None], len(pairs), axis=0)
        normals.append(_turned(turns, tiled).reshape(-1, 3, 3))
        edges.append(np.tile(shape.edges, len(pairs)))
    positions = np.concatenate(at).reshape(-1, 3).astype(np.float32)
    corners = np.arange(len(positions), dtype=np.int32).reshape(-1, 3)
    return (
        positions,
        corners,
        np.concatenate(normals).astype(np.float32),
        None,
        np.concatenate(edges),
    )


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1]) + a[..., 2] * b[..., 2]


def _turned(turns: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Turn the points of each item: (N, 3, 3) and (N, ..., 3)."""
    return np.stack([_dot(turns[:, r][:, None, None], points) for r in range(3)], axis=-1)


def _turns(direction: np.ndarray) -> np.ndarray:
    """Return the rotations of the z axis to directions, about the axis between them, (N, 3, 3)."""
    length = np.sqrt(_dot(direction, direction))
    x, y, z = (direction / np.maximum(length, 1e-15)[:, None]).T
    opposite = z < -1 + 1e-12
    share = 1 / np.where(opposite, 1.0, 1 + z)
    out = np.empty((len(direction), 3, 3))
    out[:, 0] = np.stack([1 - x * x * share, -x * y * share, x], axis=1)
    out[:, 1] = np.stack([-x * y * share, 1 - y * y * share, y], axis=1)
    out[:, 2] = np.stack([-x, -y, z], axis=1)
    out[opposite] = np.diag([1.0, -1.0, -1.0])
    return out


# ---- the camera ----


def camera_of(scene: Any, aspect: float, which: int = -1) -> tuple[np.ndarray, bool]:
    """Return the camera's numbers for the core, and whether it is orthographic.

    Parameters
    ----------
    scene : mujoco.MjvScene
    aspect : float
        Width over height.
    which : int
        0 or 1: an eye of stereo pictures; -1: the one between both.

    Raises
    ------
    InvalidArgumentError
        The scene has not been filled: its camera has no near plane, which ends programs of MuJoCo.
    """
    eyes = scene.camera if which < 0 else (scene.camera[which],)
    count = len(eyes)
    position = [sum(v) / count for v in zip(*(eye.pos.tolist() for eye in eyes), strict=True)]
    forward = _unit([sum(v) for v in zip(*(eye.forward.tolist() for eye in eyes), strict=True)])
    up = [sum(v) for v in zip(*(eye.up.tolist() for eye in eyes), strict=True)]
    along = _inner(up, forward)
    up = _unit([u - f * along for u, f in zip(up, forward, strict=True)])
    right = _cross(forward, up)
    bottom, top, near, far, center, half = (
        sum(getattr(eye, f"frustum_{name}") for eye in eyes) / count
        for name in ("bottom", "top", "near", "far", "center", "width")
    )
    if near < _LEAST_NEAR:
        raise InvalidArgumentError(
            "the scene's camera has no near plane: fill the scene by update_scene before"
        )
    half = half or 0.5 * aspect * (top - bottom)
    rows = [[*axis, -_inner(axis, position)] for axis in (right, up, forward)]
    eye = position
    if scene.enabletransform:
        rows, eye = _transformed(scene, rows, position)
    sides = center - half, center + half, bottom, top
    numbers = [*rows[0], *rows[1], *rows[2], *eye, *sides, near, far, *perspective_depth(near, far)]
    return np.array(numbers, np.float64), bool(eyes[0].orthographic)


def perspective_depth(near: float, far: float) -> tuple[np.float32, np.float32]:
    """Return a scale and an offset: depth is offset / distance - scale.

    In float32 and in OpenGL's order: the scale loses digits, and the metres of mujoco.Renderer
    count on it.
    """
    n, f = np.float32(near), np.float32(far)
    scale = np.float32(-0.5) * (-(f + n) / (f - n)) - np.float32(0.5)
    return scale, np.float32(-0.5) * (-(np.float32(2) * f * n) / (f - n))


def _transformed(scene: Any, rows: list[_Row], position: _Row) -> tuple[list[_Row], _Row]:
    """Return eye_from_world, three rows of four, and the eye, with the scene's transformation."""
    w, x, y, z = scene.rotate.tolist()
    length = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = (v / length for v in (w, x, y, z))
    columns = [
        [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
        [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
        [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
    ]
    move, scale = scene.translate.tolist(), float(scene.scale)
    out = [
        [*(_inner(row, column) * scale for column in columns), row[3] + _inner(row, move)]
        for row in rows
    ]
    away = [p - m for p, m in zip(position, move, strict=True)]
    return out, [_inner(column, away) / scale for column in columns]


def _inner(a: _Row, b: _Row) -> float:
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]


def _unit(v: _Row) -> _Row:
    length = max(math.sqrt(_inner(v, v)), 1e-15)
    return [c / length for c in v]


def _cross(a: _Row, b: _Row) -> _Row:
    return [a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3)]
