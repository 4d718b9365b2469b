"""Data sets of pictures with ground truth, and randomisation of scenes.

`Generator` gives numbers that depend only on a seed: the same on every machine and in every
process. The functions named ``random_`` make cameras, lights, poses, textures and materials from
them. Writers define the files of a picture: COCO, BOP, WebDataset or plain folders; `write_dataset`
and `engine3d.batch` use them.
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
