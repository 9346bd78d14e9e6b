#!/usr/bin/env python3
"""What a long mission costs: its memory, what it writes and its files, every so often by the mission's clock.

day_of_patrol.py FOLDER EVERY_H CAIRN [SETTING=VALUE ...]

Runs config/missions/patrol_hour.yaml into FOLDER. Autosaves count wall clock: with a simulation that runs a hundred
times faster than real time, autosave.every_s=0.3 makes as many in a simulated day as there are in a real one.
"""
import pathlib
import re
import subprocess
import sys


def value(pid, file, key):
    for line in pathlib.Path(f"/proc/{pid}/{file}").read_text().splitlines():
        if line.startswith(key):
            return int(line.split()[1])
    return 0


def row(pid, folder, time_h, autosaves):
    sizes = {f.name: f.stat().st_size for f in sorted(folder.iterdir()) if f.is_file()}
    files = ", ".join(f"{name} {size / 1e3:.0f} kB" for name, size in sizes.items())
    print(f"{time_h:6.2f} h  memory {value(pid, 'status', 'VmRSS:') / 1024:6.1f} MB  "
          f"written {value(pid, 'io', 'write_bytes:') / 1e6:8.1f} MB  {autosaves} autosaves  {files}", flush=True)


def main():
    folder, every_h, cairn, settings = pathlib.Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3], sys.argv[4:]
    mission = pathlib.Path(__file__).parents[2] / "config/missions/patrol_hour.yaml"
    command = [cairn, "run", str(mission), "--out", str(folder)]
    for setting in settings:
        command += ["--set", setting]
    run = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, bufsize=1)
    next_h, autosaves = 0.0, 0
    for line in run.stdout:
        found = re.match(r"\s*([\d.]+) s  (.*)", line)
        if not found:
            continue
        autosaves += found.group(2).startswith("autosaved")
        time_h = float(found.group(1)) / 3600
        if time_h >= next_h:
            row(run.pid, folder, time_h, autosaves)
            next_h += every_h
    return run.wait()


if __name__ == "__main__":
    sys.exit(main())
