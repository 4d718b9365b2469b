"""Levels of detail: coarser meshes for objects that are small on the screen, used on request.

`simplify` makes coarser meshes, `Impostor` flat cards; `DetailedInstances` draws each instance with
the coarsest level that looks like the finest, `DetailedMeshes` each of many meshes.
"""

from .impostors import Impostor
from .instances import DetailedInstances
from .meshes import DetailedMeshes
from .simplification import simplify

__all__ = ["DetailedInstances", "DetailedMeshes", "Impostor", "simplify"]
