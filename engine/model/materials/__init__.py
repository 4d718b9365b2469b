"""Appearance of surfaces: materials, textures, colours and their display values."""
