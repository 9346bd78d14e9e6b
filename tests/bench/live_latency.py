#!/usr/bin/env python3
"""How long it takes from what a live robot says to the velocity that answers it, beside the tick, and the share of a
processor that Cairn takes.

    cmake --build build/release --target cairn enki_pioneer enki_ros2
    tests/bench/live_latency.py build/release out/live_latency

Two missions in Enki, one after the other, in wall-clock time: config/missions/enki_ros2.yaml by DDS and
config/missions/enki_pioneer.yaml at a pseudo-terminal. The robot on the network measures: it looks for velocities every
0.5 ms. A Range waits for the next odometry, which comes every 70 ms, because that sets the pace. Needs nothing but
Python.
"""
import csv
import json
import os
import pathlib
import sys

from enki_runs import run_live

ANSWER_WITHIN_MS = 30  # later ones are velocities that were repeated


def share(values, ratio):
    return sorted(values)[min(len(values) - 1, int(ratio * len(values)))]


def print_latency(name, values):
    print(f"| {name} | {len(values)} | {share(values, 0.5):.1f} | {share(values, 0.99):.1f} | {max(values):.1f} |")


def main():
    build, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    ended = {road: run_live(build, road, out / road, {}) for road in ("ros2", "serial")}
    print("| ms | count | median | p99 | worst |\n|---|---:|---:|---:|---:|")
    with open(out / "ros2/latencies.csv") as file:
        rows = [(what, float(ms)) for what, ms in csv.reader(file)]
    odometry = [ms for what, ms in rows if what == "odometry"]
    answers = [ms for ms in odometry if ms <= ANSWER_WITHIN_MS]
    print_latency("DDS: from an odometry to its velocity", answers)
    print_latency("DDS: from a `Range` to the first velocity that knows it", [ms for what, ms in rows if what == "range"])
    for road, name in (("ros2", "DDS"), ("serial", "serial")):
        times = json.loads((out / road / "out/timing.json").read_text())
        tick = next(t for t in times if t["stage"] == "tick")
        print(f"| {name}: a tick | {tick['count']} | {tick['median_us'] / 1e3:.1f} | {tick['p99_us'] / 1e3:.1f} | "
              f"{tick['worst_us'] / 1e3:.1f} |")
    print(f"\nNo answer within {ANSWER_WITHIN_MS} ms, or a repeated velocity: {len(odometry) - len(answers)} of "
          f"{len(odometry)}.\n")
    print("| | mission | wall s | of a processor |\n|---|---|---:|---:|")
    for road, name in (("ros2", "DDS"), ("serial", "serial")):
        run = ended[road]
        print(f"| {name} | {run['report']['outcome']} | {run['wall_s']:.0f} | {100 * run['cpu_s'] / run['wall_s']:.1f} % |")
    print(f"\nLoad of the computer at the end: {os.getloadavg()[1]:.1f} (5 minutes), {os.cpu_count()} processors.")


main()
