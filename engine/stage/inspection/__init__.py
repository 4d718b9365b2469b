"""Inspecting models: sections and parts taken apart, as scenes that are drawn like any other."""
