"""Environments: panoramic images that light a scene and serve as its background."""
