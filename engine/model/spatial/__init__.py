"""Raycasts, picking and colliders in a scene. Trees of boxes in C do the searching."""
