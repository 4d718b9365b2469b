"""Data sets of pictures with the truth about them, and what makes each picture another one.

`Generator` gives numbers that follow from a seed alone: the same on every machine, whichever
process asks. The functions named ``random_`` make cameras, lights, poses, textures and materials of
them. The writers say which files a picture becomes: COCO, BOP, WebDataset or plain folders;
`write_dataset` writes them, and so does `engine3d.batch`.
"""

from .bop import BopWriter
from .coco import CocoWriter
from .folders import FolderWriter
from .generator import Generator
from .random_scenes import (
    random_camera,
    random_light,
    random_material,
    random_pose,
    random_texture,
    scatter,
)
from .rle import decode_rle, encode_rle
from .samples import Sample
from .web import WebDatasetWriter
from .writer import DatasetWriter
from .writing import write_dataset

__all__ = [
    "BopWriter",
    "CocoWriter",
    "DatasetWriter",
    "FolderWriter",
    "Generator",
    "Sample",
    "WebDatasetWriter",
    "decode_rle",
    "encode_rle",
    "random_camera",
    "random_light",
    "random_material",
    "random_pose",
    "random_texture",
    "scatter",
    "write_dataset",
]
