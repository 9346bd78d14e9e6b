#!/usr/bin/env python3
"""Robots that go on with a saved map: is it noticed which of them were carried while they were switched off?

    tests/bench/carried_table.py OUT FIRST_SEED RUNS [WORLD...]

Each run maps a world, patrols it, and saves its map five times under way. Each of these maps is continued twice: where
the robot stood then, and carried 1 to 6 m from there and turned at random. OUT/rows_FIRST_SEED.json holds what each
look of the check has seen.
"""
import concurrent.futures, json, math, pathlib, random, sqlite3, statistics, struct, subprocess, sys, zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAIRN = ROOT / "build/release/bin/cairn"
CONTINUED_S = 80
WRONG_M = 0.5
SAVED = ["early", "half", "nearly", "mapped", "patrolled"]
WORLDS = {  # world, robot, start of the run that maps it, box of the places that a robot may be carried to
    "office": ("office", "pioneer1", (0.6, 0.6), (0, 0, 6, 5)),
    "my_flat": ("my_flat", "pioneer1", (0.8, 0.8), (0, 0, 8.4, 8)),
    "joined_rooms": ("joined_rooms", "pioneer1", (0.6, 0.6), (0, 0, 12, 5)),
    "two_rooms": ("two_rooms", "pioneer1", (0.6, 0.6), (0, 0, 12, 6)),
    "home_laser": ("turtlebot_home", "turtlebot3", (0.6, 2.6), (0, 0, 7, 6)),
    "office_laser": ("office", "pioneer3dx_laser", (0.6, 0.6), (0, 0, 6, 5)),
}
MISSION = """mission: carried
seed: {seed}
robot: {root}/config/robots/{robot}.yaml
world: {root}/config/worlds/{world}.yaml
start: {{at_m: [{x}, {y}], angle_deg: 0}}
sensor: {{plugin: simulated_robot}}
localizer: {{plugin: odometry_compass}}
map: {{plugin: muriel, cell_m: 0.05}}
detector: {{plugin: template_matcher, templates: {root}/config/templates, coarse_cells: 5}}
planner: {{plugin: hybrid}}
at_most_s: {at_most_s}
steps:
  - force_success: {{explore: {{until_known_ratio: 0.35, at_most_s: 200}}}}
  - save: early.cairn
  - force_success: {{explore: {{until_known_ratio: 0.65, at_most_s: 200}}}}
  - save: half.cairn
  - force_success: {{explore: {{until_known_ratio: 0.85, at_most_s: 200}}}}
  - save: nearly.cairn
  - force_success: {{explore: {{until_known_ratio: 0.93, at_most_s: 200}}}}
  - save: mapped.cairn
  - force_success: {{patrol: {{rounds: 1, order: shortest, skip: true}}}}
  - save: patrolled.cairn
  - repeat: {{times: 9, do: [{{force_success: {{return_home: }}}}, {{force_success: {{patrol: {{rounds: 1, skip: true}}}}}}]}}
"""


def run(folder, world, seed, at_most_s, *options):
    folder.mkdir(parents=True, exist_ok=True)
    name, robot, start, _ = WORLDS[world]
    mission = folder / "mission.yaml"
    mission.write_text(MISSION.format(root=ROOT, world=name, robot=robot, seed=seed, x=start[0], y=start[1],
                                      at_most_s=at_most_s))
    done = subprocess.run([CAIRN, "run", mission, "--out", folder, "--json", *options], capture_output=True, text=True)
    if not done.stdout.startswith("{"):
        return {"refused": done.stderr}
    report = json.loads((folder / "report.json").read_text())
    return json.loads(done.stdout) | {"start_check": report.get("start_check"), "events": report["events"]}


def canonical(value):
    if isinstance(value, int):
        return b"\1" + struct.pack("<q", value)
    if isinstance(value, float):
        return b"\2" + struct.pack("<d", value)
    return b"\4" if value is None else b"\3" + struct.pack("<q", len(value.encode())) + value.encode()


def put(map_file, x_m, y_m, theta_rad):
    """The simulated robot of a saved map stands there (docs/formats.md)."""
    with sqlite3.connect(map_file) as db:
        db.execute("UPDATE progress SET true_x_m=?, true_y_m=?, true_theta_rad=?", (x_m, y_m, theta_rad))
        row = db.execute("SELECT * FROM progress").fetchone()
        db.execute("UPDATE checksums SET crc32=? WHERE table_name='progress'",
                   (zlib.crc32(b"".join(canonical(value) for value in row)),))
    db.close()


def true_pose(map_file):
    db = sqlite3.connect(map_file)
    row = db.execute("SELECT time_s, distance_m, true_x_m, true_y_m, true_theta_rad FROM progress").fetchone()
    db.close()
    return row


def continued(out, world, seed, saved, is_carried):
    places = random.Random(f"{world} {seed} {saved}")
    map_file = out / f"{world}_{seed}" / f"{saved}.cairn"
    time_s, before_m, x, y, _ = true_pose(map_file)
    folder = out / f"{world}_{seed}_{saved}_{'carried' if is_carried else 'stayed'}"
    row = {"world": world, "seed": seed, "saved": saved, "carried": is_carried}
    while True:
        if is_carried:
            far_m, way_rad = places.uniform(1.0, 6.0), places.uniform(-math.pi, math.pi)
            to = (x + far_m * math.cos(way_rad), y + far_m * math.sin(way_rad))
            x0, y0, x1, y1 = WORLDS[world][3]
            if not (x0 < to[0] < x1 and y0 < to[1] < y1):
                continue
            moved = out / f"{world}_{seed}_{saved}.cairn"
            moved.write_bytes(map_file.read_bytes())
            map_file = moved
            put(map_file, *to, places.uniform(-math.pi, math.pi))
            row["far_m"] = far_m
        done = run(folder, world, seed, time_s + CONTINUED_S, "--resume", str(map_file))
        if "cannot start" in done.get("refused", "") or "cannot start" in done.get("reason", ""):
            continue  # in a wall
        if "refused" in done:
            sys.exit(done["refused"])
        return row | {"driven_m": done["distance_m"] - before_m, "start_check": done["start_check"],
                      "events": done["events"], "touches": done["collisions"],
                      "error_m": done.get("pose_error", {}).get("last_m"), "found": done.get("localisation")}


def map_world(out, world, seed):
    if not (out / f"{world}_{seed}" / f"{SAVED[-1]}.cairn").exists():
        run(out / f"{world}_{seed}", world, seed, 900)


def print_table(rows):
    print("| world | stayed | of these false alarms | carried | noticed | within 5 m | driven m, median | found again | wrongly |"
          " touches |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
    for world in [*dict.fromkeys(row["world"] for row in rows), "all"]:
        mine = [row for row in rows if world in ("all", row["world"])]
        stayed = [row for row in mine if not row["carried"]]
        carried = [row for row in mine if row["carried"]]
        noticed = [row for row in carried if row["start_check"]["trust"] == "carried"]
        at_m = [row["start_check"]["looks"][-1]["driven_m"] for row in noticed]
        found = [row for row in noticed if row["found"]["trust"] == "tracking"]
        print(f"| {world} | {len(stayed)} | {sum(row['start_check']['trust'] == 'carried' for row in stayed)} | {len(carried)} | "
              f"{len(noticed)} | {sum(m <= 5 for m in at_m)} | {statistics.median(at_m):.1f} | {len(found)} | "
              f"{sum(row['error_m'] > WRONG_M for row in found)} | {sum(row['touches'] for row in mine)} |")
    print("\n| looks | number | score: least, median, most | contradicted %: least, median, most |\n|---|---:|---:|---:|")
    for name, is_carried in (("stayed", False), ("carried", True)):
        looks = [look["believed"] for row in rows if row["carried"] == is_carried for look in row["start_check"]["looks"]]
        of = lambda key, by, digits: ", ".join(f"{by * f([look[key] for look in looks]):.{digits}f}"
                                               for f in (min, statistics.median, max))
        print(f"| {name} | {len(looks)} | {of('score', 1, 2)} | {of('contradicted_ratio', 100, 1)} |")


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    first, runs = int(sys.argv[2]), int(sys.argv[3])
    worlds = sys.argv[4:] or ["office", "my_flat", "joined_rooms", "home_laser"]
    jobs = [(world, seed) for seed in range(first, first + runs) for world in worlds]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda job: map_world(out, *job), jobs))
        rows = list(pool.map(lambda job: continued(out, *job),
                             [(*job, saved, is_carried) for job in jobs for saved in SAVED
                              for is_carried in (False, True) if (out / f"{job[0]}_{job[1]}/{saved}.cairn").exists()]))
    (out / f"rows_{first}.json").write_text(json.dumps(rows, indent=1))
    print_table(rows)


main()
