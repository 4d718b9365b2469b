"""Procedural worlds of any size, for walking and benchmarks.

`city` makes a city. Everything in it follows from a seed by integer hashes and element-wise
float64 arithmetic: the same bytes on every machine.
"""

from .city import World, city

__all__ = ["World", "city"]
