#!/usr/bin/env python3
"""What those who watch cost a mission: watchers.py CAIRN MISSION FOLDER [RUNS]

Runs the mission with nobody, one, eight and eight stalled watchers, and prints the time of the host's listeners.
"""
import json
import pathlib
import socket
import statistics
import subprocess
import sys
import threading
import time


def watch(path, is_stalled):
    client = socket.socket(socket.AF_UNIX)
    client.connect(str(path))
    client.sendall(b"watch\n")
    while not is_stalled and client.recv(1 << 20):
        pass
    return client


def run(cairn, mission, out, watchers, is_stalled):
    """Times of a tick's listeners in us, and seconds of wall clock for the whole mission."""
    begin = time.monotonic()
    program = subprocess.Popen([cairn, "run", mission, "--out", out, "--json"], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL)
    path = pathlib.Path(out) / "control.sock"
    while watchers and not path.exists():
        time.sleep(0.001)
    kept = []
    threads = [threading.Thread(target=lambda: kept.append(watch(path, is_stalled))) for _ in range(watchers)]
    for thread in threads:
        thread.start()
    program.communicate()
    wall_s = time.monotonic() - begin
    for thread in threads:
        thread.join()
    times = {row["stage"]: row for row in json.loads((pathlib.Path(out) / "timing.json").read_text())}
    ticks = times["tick"]["count"]
    return 1e6 * times["listeners"]["total_s"] / ticks, times["listeners"]["p99_us"], wall_s


def main():
    cairn, mission, folder = sys.argv[1:4]
    runs = int(sys.argv[4]) if len(sys.argv) > 4 else 5
    cases = [("nobody", 0, False), ("one", 1, False), ("eight", 8, False), ("eight, stalled", 8, True)]
    figures = {name: [] for name, _, _ in cases}
    for i in range(runs):  # in turn, so that what else the machine does meets all alike
        for name, watchers, is_stalled in cases:
            out = f"{folder}/{name.replace(', ', '_')}_{i}"
            figures[name].append(run(cairn, mission, out, watchers, is_stalled))
    print("| who watches | listeners, us a tick | 99 % of ticks, us | mission, s of wall clock |\n|---|---:|---:|---:|")
    for name, rows in figures.items():
        print(f"| {name} | " + " | ".join(f"{statistics.median(row[i] for row in rows):.{digits}f}"
                                           for i, digits in ((0, 2), (1, 1), (2, 2))) + " |")


main()
