"""The looks of surfaces: materials, textures, and how colours are given and shown."""
