#!/usr/bin/env python3
"""Whether a map stays the same when its mission is continued again and again.

    PYTHONPATH=build/release/python tests/bench/continued_table.py OUT [MISSION [TIMES [SECONDS]]]

A mission that patrols for ever (config/missions/patrol_hour.yaml; slam_patrol.yaml for laser SLAM, whose submaps are
counted too) runs for SECONDS (600), and is then continued from its saved map for as long again, TIMES (10) in all. Each
map is compared with that of the second run, by when all places have been seen: each occupied cell (p > 0.65) with the
nearest occupied cell of the other map, both ways, and the landmarks.
"""
import json, pathlib, subprocess, sys

import numpy

import cairn

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/bin/cairn"
OCCUPIED = 0.65


def run(mission, folder, until_s, saved):
    """Its map, saved in the folder."""
    command = [PROGRAM, "run", mission, "--out", folder, "--set", f"at_most_s={until_s}", "--json"]
    if saved:
        command += ["--resume", saved]
    done = subprocess.run(command, capture_output=True, text=True)
    maps = [path for path in folder.glob("*.cairn") if ".autosave." not in path.name]
    if len(maps) != 1:
        sys.exit(f"{folder}: {done.stderr or 'no map'}")
    return maps[0]


def walls(map):
    row, column = numpy.nonzero(map.grid.probability() > OCCUPIED)
    return numpy.column_stack([column, row]) * map.grid.cell_m + numpy.asarray(map.grid.origin_m)


def nearest_m(points, others):
    return numpy.array([numpy.hypot(*(others - point).T).min() for point in points])


def submap_figures(saved, map):
    """Of a map with submaps: how many, their nodes and edges, and how far off the robot was in that run."""
    info = subprocess.run([PROGRAM, "map", "info", saved, "--json"], capture_output=True, text=True, check=True)
    counts = json.loads(info.stdout)
    error = json.loads((saved.parent / "report.json").read_text())["pose_error"]
    return (f" {len(list(map.submaps))} | {counts['submap_nodes']} | {counts['submap_edges']} | "
            f"{error['median_m']:.3f} | {error['worst_m']:.3f} |")


def places(map):
    return {mark.id: numpy.asarray(mark.pose[:2]) for mark in map.landmarks}


def main():
    out = pathlib.Path(sys.argv[1])
    mission = sys.argv[2] if len(sys.argv) > 2 else ROOT / "config/missions/patrol_hour.yaml"
    times = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    seconds = int(sys.argv[4]) if len(sys.argv) > 4 else 600
    saved, maps = None, []
    for time in range(1, times + 1):
        saved = run(mission, out / str(time), seconds * time, saved)
        maps.append(saved)
    second = cairn.load(str(maps[1]))
    has_submaps = len(list(second.submaps)) > 0
    print("| run | file, kB | tiles | occupied cells | to the second map's, 95 %, m | from them, 95 %, m | "
          "landmarks | moved by, most, m |" +
          (" submaps | nodes | edges | pose error, median, m | worst, m |" if has_submaps else ""))
    print("|---:|---:|---:|---:|---:|---:|---:|---:|" + ("---:|---:|---:|---:|---:|" if has_submaps else ""))
    for time, path in enumerate(maps, 1):
        map = cairn.load(str(path))
        here, there = walls(map), walls(second)
        moved = [numpy.hypot(*(place - places(second)[id])) for id, place in places(map).items() if id in places(second)]
        print(f"| {time} | {path.stat().st_size / 1000:.0f} | {len(list(map.grid.tiles))} | {len(here)} | "
              f"{numpy.quantile(nearest_m(here, there), 0.95):.3f} | {numpy.quantile(nearest_m(there, here), 0.95):.3f} | "
              f"{len(map.landmarks)} | {max(moved, default=0):.3f} |" +
              (submap_figures(path, map) if has_submaps else ""))


if __name__ == "__main__":
    main()
