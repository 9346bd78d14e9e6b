#!/usr/bin/env python3
"""Laser SLAM once round a plain corridor: does a tag close the loop?

    tests/bench/ring_table.py OUT [RUNS]

Each seed drives config/missions/ring_corridor.yaml twice, with the tag on the wall and without it. The error is that of
the pose at the end of the drive; drives that were blocked on the way have none.
"""
import concurrent.futures, json, pathlib, random, statistics, subprocess, sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAIRN = ROOT / "build/release/bin/cairn"
WORLD = ROOT / "config/worlds/ring_corridor.yaml"


def interval(values):
    draws = random.Random(1)
    medians = sorted(statistics.median(draws.choices(values, k=len(values))) for _ in range(1000))
    return f"{statistics.median(values):.2f} ({medians[25]:.2f} - {medians[974]:.2f}), {max(values):.2f}"


def run(out, seed, has_tag):
    folder = out / f"{'tag' if has_tag else 'bare'}_{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    text = WORLD.read_text()
    (folder / "world.yaml").write_text(text if has_tag else text[:text.index("tags:")])
    done = subprocess.run([CAIRN, "run", ROOT / "config/missions/ring_corridor.yaml", "--out", folder, "--json", "--seed",
                           str(seed), "--set", f"world={folder / 'world.yaml'}"], capture_output=True, text=True)
    return json.loads(done.stdout)


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    print("| | drives | came round | error at the end m, median, most |\n|---|---:|---:|---:|")
    jobs = [(seed, has_tag) for seed in range(1, runs + 1) for has_tag in (False, True)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda job: (job, run(out, *job)), jobs))
    for has_tag in (False, True):
        mine = [row for (_, tagged), row in rows if tagged == has_tag]
        ends = [row["pose_error"]["last_m"] for row in mine if row["outcome"] == "done"]
        print(f"| {'with' if has_tag else 'without'} the tag | {runs} | {len(ends)} | {interval(ends) if ends else ''} |")
    for (seed, has_tag), row in rows:
        print(f"seed {seed}, {'tag' if has_tag else 'bare'}: {row['outcome']}, {row['pose_error']['last_m']:.3f} m",
              file=sys.stderr)


main()
