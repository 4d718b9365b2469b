"""Levels of detail: coarser meshes for what is small on the screen. Nothing uses them by itself.

`simplify` makes coarser meshes, `Impostor` flat cards; `DetailedInstances` draws each instance with
the coarsest that nobody can tell from the finest, `DetailedMeshes` each of many meshes.
"""

from .impostors import Impostor
from .instances import DetailedInstances
from .meshes import DetailedMeshes
from .simplification import simplify

__all__ = ["DetailedInstances", "DetailedMeshes", "Impostor", "simplify"]
