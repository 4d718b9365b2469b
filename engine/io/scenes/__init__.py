"""Conversion between scenes, documents and records."""
