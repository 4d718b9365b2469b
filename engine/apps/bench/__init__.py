"""Benchmarks of the engine, for ``engine3d bench`` and the scripts of benchmarks/.

`measuring` times the workloads of `engine3d.apps.scenes.workloads`; `report` formats the figures.
Charts and comparisons with other software are in benchmarks/.
"""
