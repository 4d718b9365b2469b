from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

TRIANGLES: int
LINES: int
POINTS: int
LIT: int
FLAT: int
PLAIN: int
DEPTH: int
REPEAT: int
CLAMP: int
MIRROR: int
DIRECTIONAL: int
POINT: int
SPOT: int
SAMPLES: int
CENTRE: int
PLACES: int
LEVELS: int

class NativeShape:
    def __init__(
        self,
        mode: int,
        indices: NDArray[np.int32],
        positions: NDArray[np.float32],
        normals: NDArray[np.float32] | None = None,
        uvs: NDArray[np.float32] | None = None,
        colors: NDArray[np.float32] | None = None,
    ) -> None: ...

class NativeTexture:
    def __init__(
        self,
        levels: list[NDArray[np.uint8]],
        wrap_u: int,
        wrap_v: int,
        linear_near: bool,
        linear_far: bool,
        blends_levels: bool,
    ) -> None: ...

class NativePicture:
    draw_count: int
    light_count: int
    step_count: int
    def clear(self) -> None: ...
    def add_light(
        self,
        kind: int,
        color: Sequence[float] | NDArray[Any],
        position: Sequence[float] | NDArray[Any],
        direction: Sequence[float] | NDArray[Any],
        cone_scale: float,
        cone_offset: float,
        shadow_map: NDArray[np.float32] | None = None,
        shadow_from_world: NDArray[np.float64] | None = None,
    ) -> None: ...
    def add_lights_of_draws(self, numbers: Iterable[int]) -> int: ...
    def add_draw(
        self,
        shape: NativeShape,
        world: NDArray[np.float64],
        culls_backs: bool,
        is_wireframe: bool,
        blends: bool,
        color: Sequence[float] | NDArray[Any],
        metallic: float,
        roughness: float,
        emissive: Sequence[float] | NDArray[Any],
        textures: tuple[NativeTexture | None, ...],
        first_light: int,
        light_count: int,
    ) -> None: ...
    def add_drawn(self, first: int, count: int) -> None: ...
    def add_visible(
        self,
        places: list[tuple[NDArray[np.int32] | None, ...]],
        draw_of_object: NDArray[np.int32],
    ) -> None: ...
    def render(
        self,
        samples: int,
        shading: int,
        clip_from_world: NDArray[np.float64],
        eye: Sequence[float] | NDArray[Any],
        ambient: Sequence[float] | NDArray[Any],
        background: Sequence[float] | NDArray[Any],
        point_size: float,
        depth_near: float,
        depth_far: float,
        depth_is_straight: bool,
        depth_place: int,
        threads: int,
        color: NDArray[np.uint8] | None,
        depth: NDArray[np.float32],
    ) -> None: ...
