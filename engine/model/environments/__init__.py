"""Environments: pictures of everything around, as light and as background."""
