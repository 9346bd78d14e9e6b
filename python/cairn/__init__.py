"""Cairn in Python: saved maps as arrays, plans on them, missions and experiments.

    import cairn
    map = cairn.load("out/office.cairn")
    plan = map.plan((0.6, 0.6), "nearest square")
    print(plan.outcome, plan.length_m, plan.path.shape)

Lengths are metres, angles radians, times seconds. Arrays of poses have the columns x, y, heading.
"""
from cairn._native import Cluster, Grid, Landmark, Route, Tick
from cairn.errors import CairnError, FileError, MapError, ModuleError
from cairn.logs import Log, read_log
from cairn.maps import Map, load
from cairn.plans import Plan
from cairn.runs import Experiment, Run, experiment, run

__all__ = ["CairnError", "Cluster", "Experiment", "FileError", "Grid", "Landmark", "Log", "Map", "MapError",
           "ModuleError", "Plan", "Route", "Run", "Tick", "experiment", "load", "read_log", "run"]
