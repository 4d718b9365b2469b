import numpy as np
from numpy.typing import NDArray

WALKABLE: int
SOLID: int

class NativeGrid:
    def __init__(
        self,
        x: float,
        z: float,
        cell: float,
        columns: int,
        rows: int,
        min_normal_y: float,
        step: float,
        headroom: float,
        radius: float,
    ) -> None: ...
    def add(
        self,
        ground: bool,
        positions: NDArray[np.float32],
        faces: NDArray[np.int32],
        material_ids: NDArray[np.int32],
        kinds: NDArray[np.uint8],
        world_from_mesh: NDArray[np.float64],
    ) -> None: ...
    def sort(self) -> None: ...
    def layers(self) -> tuple[NDArray, NDArray, NDArray, NDArray, NDArray]: ...
