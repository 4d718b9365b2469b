"""Shared by writers: names, side files, losses."""
