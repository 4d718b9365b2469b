"""Shared code of readers: sources, documents, limits, mesh construction."""
