import numpy as np
from numpy.typing import NDArray

MAX_SIDE: int
LINE_ALGORITHMS: dict[str, int]
TRIANGLE_ALGORITHMS: dict[str, int]

_Bytes = bytes | NDArray[np.uint8]

class Surface:
    def __init__(self, pixels: NDArray[np.uint8]) -> None: ...
    def clear(self, color: _Bytes) -> None: ...
    def rectangle(
        self, x: float, y: float, width: float, height: float, color: _Bytes, fill: bool
    ) -> None: ...
    def point(self, x: float, y: float, color: _Bytes) -> None: ...
    def points(self, xy: NDArray[np.float64], colors: _Bytes) -> None: ...
    def line(
        self,
        x0: float,
        y0: float,
        x1: float,
        y1: float,
        color: _Bytes,
        width: float,
        algorithm: int,
    ) -> None: ...
    def lines(
        self, xyxy: NDArray[np.float64], colors: _Bytes, width: float, algorithm: int
    ) -> None: ...
    def polyline(
        self, xy: NDArray[np.float64], closed: bool, color: _Bytes, width: float, algorithm: int
    ) -> None: ...
    def triangle(
        self,
        ax: float,
        ay: float,
        bx: float,
        by: float,
        cx: float,
        cy: float,
        color: _Bytes,
        algorithm: int,
    ) -> None: ...
    def triangles(self, xyxyxy: NDArray[np.float64], colors: _Bytes, algorithm: int) -> None: ...
    def text(self, x: float, y: float, codes: _Bytes, scale: int, color: _Bytes) -> None: ...

def text_size(codes: _Bytes, scale: int) -> tuple[int, int]: ...
