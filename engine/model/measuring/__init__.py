"""Measures surfaces: mass, faults, distances. In float64, the same bits on every machine."""
