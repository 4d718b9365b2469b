"""The engine measured on this machine, for ``engine3d bench`` and the scripts of benchmarks/.

`names` says what can be drawn, `workloads` makes it, `measuring` times it, `llvmpipe` draws the
same with Mesa, `report` and `bar_chart` show the figures, `city_views` walks through the city.
"""
