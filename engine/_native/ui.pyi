from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

MAX_SIDE: int
FILTERS: dict[str, int]
VERTEX_BYTES: int

class NativeTexture:
    def __init__(self, pixels: NDArray[np.uint8], filter: int, opaque: bool) -> None: ...

class NativeTextures:
    def __init__(self, textures: Iterable[NativeTexture]) -> None: ...

def draw(
    backend: int,
    pixels: NDArray[np.uint8],
    vertices: NDArray[np.uint8],
    indices: NDArray[np.uint16] | NDArray[np.uint32],
    commands: NDArray[np.int32],
    textures: NativeTextures,
) -> None: ...
