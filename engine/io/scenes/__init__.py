"""Scenes of what files hold, and records of them."""
