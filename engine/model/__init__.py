"""What is drawn: meshes, materials, environments, scenes, motion. None of it draws."""
