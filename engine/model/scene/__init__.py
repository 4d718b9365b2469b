"""Scenes: trees of nodes that hold meshes, instances, lights and cameras."""
