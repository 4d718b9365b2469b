"""Measures of surfaces: volume and inertia, faults, distances between things."""

from .model.measuring.checking import Faults, check
from .model.measuring.deviations import Deviation, hausdorff
from .model.measuring.distances import Gap, distance
from .model.measuring.mass import Measures, measure

__all__ = ["Deviation", "Faults", "Gap", "Measures", "check", "distance", "hausdorff", "measure"]
