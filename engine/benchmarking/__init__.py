"""The engine measured on this machine, for ``engine3d bench`` and the scripts of benchmarks/.

`names` says what can be drawn, `workloads` makes it, `measuring` times it, `report` shows the
figures as text, `city_views` walks through the city. Charts and the peer are in benchmarks/.
"""
