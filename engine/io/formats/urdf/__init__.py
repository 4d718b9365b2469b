"""URDF, the Unified Robot Description Format: links, joints, and the shapes that show them."""
