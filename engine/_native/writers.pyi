import numpy as np
from numpy.typing import NDArray

V: int
V_VT: int
V_VN: int
V_VT_VN: int

def float_rows(rows: NDArray[np.float32], between: list[bytes]) -> NDArray[np.uint8]: ...
def face_lines(
    sizes: NDArray[np.int32],
    positions: NDArray[np.int32],
    others: NDArray[np.int32] | None,
    form: int,
) -> tuple[NDArray[np.uint8], NDArray[np.int64]]: ...
