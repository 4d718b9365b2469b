"""The engine measured on this machine, for ``engine3d bench`` and the scripts of benchmarks/.

`measuring` times what `engine3d.apps.scenes.workloads` makes, `report` shows the figures as text.
Charts and the peer are in benchmarks/.
"""
