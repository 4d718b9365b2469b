"""Foundations of all packages: argument checks, change tracking, files, linear algebra."""
