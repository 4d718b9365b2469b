"""Shapes of nodes for queries by boxes, spheres and rays."""

from .model.spatial.colliders import BoxCollider, ColliderHit, MeshCollider, SphereCollider

__all__ = ["BoxCollider", "ColliderHit", "MeshCollider", "SphereCollider"]
