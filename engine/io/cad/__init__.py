"""Shapes of Open CASCADE, which CadQuery and build123d hold: their meshes, trees and files."""
