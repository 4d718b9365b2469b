"""The model: meshes, materials, environments, scenes, motion. None of it draws."""
