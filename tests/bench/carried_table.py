#!/usr/bin/env python3
"""Robots that go on with a saved map: is it noticed which of them were carried?

    tests/bench/carried_table.py OUT FIRST_SEED RUNS [WORLD...]                 while they were switched off
    tests/bench/carried_table.py --under-way OUT FIRST_SEED RUNS [WORLD...]     while their mission was under way

Each run maps a world, patrols it, and saves its map five times under way. Each of these maps is continued twice: as it
was left, and with the robot carried 1 to 6 m and turned at random. OUT/rows_FIRST_SEED.json holds what each look of
the check has seen. Under way the robot goes on where it stood, and is carried after 60 to 100 s.
"""
import concurrent.futures, json, math, pathlib, random, sqlite3, statistics, struct, subprocess, sys, zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAIRN = ROOT / "build/release/bin/cairn"
CONTINUED_S = 80
UNDER_WAY_S = 300  # the same, of robots that are carried under way
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


def place_to_be_carried_to(places, world, x, y):
    while True:
        far_m, way_rad = places.uniform(1.0, 6.0), places.uniform(-math.pi, math.pi)
        to = (x + far_m * math.cos(way_rad), y + far_m * math.sin(way_rad))
        x0, y0, x1, y1 = WORLDS[world][3]
        if x0 < to[0] < x1 and y0 < to[1] < y1:
            return far_m, to, places.uniform(-math.pi, math.pi)


def under_way(out, world, seed, saved, is_carried):
    """The robot goes on where it was; it is carried once the check of its start is over."""
    places = random.Random(f"{world} {seed} {saved} under way")
    map_file = out / f"{world}_{seed}" / f"{saved}.cairn"
    time_s = true_pose(map_file)[0]
    carried_s = time_s + places.uniform(60, 100)
    folder = out / f"{world}_{seed}_{saved}_{'under_way' if is_carried else 'left_alone'}"
    row = {"world": world, "seed": seed, "saved": saved, "carried": is_carried}
    if is_carried:
        until = out / f"{world}_{seed}_{saved}_until"
        if not (until / "carried.cairn").exists():
            run(until, world, seed, carried_s, "--resume", str(map_file))
        _, carried_at_m, x, y, _ = true_pose(until / "carried.cairn")
        row |= {"carried_s": carried_s, "carried_at_m": carried_at_m}
    while True:
        faults = "[]"
        if is_carried:
            row["far_m"], to, angle_rad = place_to_be_carried_to(places, world, x, y)
            faults = f"[{{at_s: {carried_s:.2f}, kidnap: {{to_m: [{to[0]:.3f}, {to[1]:.3f}], angle_deg: {math.degrees(angle_rad):.1f}}}}}]"
        done = run(folder, world, seed, time_s + UNDER_WAY_S, "--resume", str(map_file), "--set", f"sensor.faults={faults}")
        if "not free" in done.get("refused", "") or "overlap" in done.get("refused", ""):
            continue  # in a wall
        if "refused" in done:
            sys.exit(done["refused"])
        return row | {"distance_m": done["distance_m"], "doubts": done.get("doubts", []), "noticed": done.get("carried", []),
                      "start_check": done["start_check"], "touches": done["collisions"], "reason": done["reason"],
                      "error_m": done.get("pose_error", {}).get("last_m"), "events": done["events"]}


def continued(out, world, seed, saved, is_carried):
    places = random.Random(f"{world} {seed} {saved}")
    map_file = out / f"{world}_{seed}" / f"{saved}.cairn"
    time_s, before_m, x, y, _ = true_pose(map_file)
    folder = out / f"{world}_{seed}_{saved}_{'carried' if is_carried else 'stayed'}"
    row = {"world": world, "seed": seed, "saved": saved, "carried": is_carried}
    while True:
        if is_carried:
            row["far_m"], to, angle_rad = place_to_be_carried_to(places, world, x, y)
            moved = out / f"{world}_{seed}_{saved}.cairn"
            moved.write_bytes(map_file.read_bytes())
            map_file = moved
            put(map_file, *to, angle_rad)
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
        noticed = [row for row in carried if row["start_check"]["verdict"] == "carried"]
        at_m = [row["start_check"]["looks"][-1]["driven_m"] for row in noticed]
        found = [row for row in noticed if row["found"]["trust"] == "tracking"]
        print(f"| {world} | {len(stayed)} | {sum(row['start_check']['verdict'] == 'carried' for row in stayed)} | {len(carried)} | "
              f"{len(noticed)} | {sum(m <= 5 for m in at_m)} | {statistics.median(at_m):.1f} | {len(found)} | "
              f"{sum(row['error_m'] > WRONG_M for row in found)} | {sum(row['touches'] for row in mine)} |")
    print("\n| looks | number | score: least, median, most | contradicted %: least, median, most |\n|---|---:|---:|---:|")
    for name, is_carried in (("stayed", False), ("carried", True)):
        looks = [look["believed"] for row in rows if row["carried"] == is_carried for look in row["start_check"]["looks"]]
        of = lambda key, by, digits: ", ".join(f"{by * f([look[key] for look in looks]):.{digits}f}"
                                               for f in (min, statistics.median, max))
        print(f"| {name} | {len(looks)} | {of('score', 1, 2)} | {of('contradicted_ratio', 100, 1)} |")


def print_under_way(rows):
    print("| world | left alone | of these doubted | false alarms | carried | noticed | driven m until then, median, most | found |"
          " driven m from there, median, most | wrongly | touches |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
    of = lambda values: f"{statistics.median(values):.1f}, {max(values):.1f}" if values else ""
    for name, mine in [(f"{world}{part}", [row for row in rows if world in ("all", row["world"]) and row["saved"] in saved])
                       for part, saved in ((", half mapped", SAVED[:3]), (", mapped", SAVED[3:]))
                       for world in [*dict.fromkeys(row["world"] for row in rows), "all"]]:
        alone = [row for row in mine if not row["carried"]]
        carried = [row for row in mine if row["carried"]]
        noticed = [row for row in carried if row["noticed"]]
        found = [row for row in noticed if "found_s" in row["noticed"][-1]]
        print(f"| {name} | {len(alone)} | {sum(len(row['doubts']) > 0 for row in alone)} | "
              f"{sum(len(row['noticed']) for row in alone)} | {len(carried)} | {len(noticed)} | "
              f"{of([row['noticed'][0]['distance_m'] - row['carried_at_m'] for row in noticed])} | {len(found)} | "
              f"{of([row['noticed'][-1]['searched_m'] - row['noticed'][-1]['driven_m'] for row in found])} | "
              f"{sum(row['error_m'] > WRONG_M for row in found)} | {sum(row['touches'] for row in mine)} |")


def main():
    is_under_way = "--under-way" in sys.argv
    arguments = [word for word in sys.argv[1:] if word != "--under-way"]
    out = pathlib.Path(arguments[0]).resolve()
    first, runs = int(arguments[1]), int(arguments[2])
    worlds = arguments[3:] or ["office", "my_flat", "joined_rooms", "home_laser"]
    jobs = [(world, seed) for seed in range(first, first + runs) for world in worlds]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda job: map_world(out, *job), jobs))
        rows = list(pool.map(lambda job: (under_way if is_under_way else continued)(out, *job),
                             [(*job, saved, is_carried) for job in jobs for saved in SAVED
                              for is_carried in (False, True) if (out / f"{job[0]}_{job[1]}/{saved}.cairn").exists()]))
    (out / f"rows_{first}{'_under_way' if is_under_way else ''}.json").write_text(json.dumps(rows, indent=1))
    (print_under_way if is_under_way else print_table)(rows)


main()
