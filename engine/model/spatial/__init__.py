"""Rays and picking in a scene. Trees of boxes in C do the searching."""
