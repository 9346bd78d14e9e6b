#!/usr/bin/env python3
"""The page of homes as maps: a picture a run and its figures, in the order of the seeds.

    build/release/bin/cairn experiment config/experiments/homes.yaml --out out/gallery --set seeds.count=10 \\
        --set "variants=[{name: pioneer1, robot: config/robots/pioneer1.yaml}]" --set baseline=pioneer1
    tests/bench/gallery.py out/gallery docs/results

Writes gallery.md, and the pictures to pictures/ beside it. Runs that did not end are left out and counted. Needs
nothing but Python.
"""
import json, pathlib, shutil, sys


def caption(row):
    home = row["home"]
    to_90 = f"{home['known_90_s']:.0f} s" if "known_90_s" in home else "never"
    return (
        f"{home['entered']} of {home['rooms']} rooms entered; {home['known_ratio']:.3f} of {home['area_m2']:.1f} m2 known, "
        f"90 % after: {to_90}; {row['distance_m']:.0f} m and {row['time_s']:.0f} s in all; contacts: {home['contacts']}, "
        f"fast: {home['fast_contacts']}. Ended with {'success' if home['success'] else 'failure'}: \"{home['end']}\".")


def main(folder, docs):
    rows = [row for row in json.loads((folder / "table.json").read_text())["rows"]]
    ended = [row for row in rows if "home" in row]
    command = __doc__.split("\n\n")[1]
    text = "# Homes as maps\n\nWhat is drawn: the map, and the truth over it: walls and furniture in orange, doors as red "
    text += "lines, rooms that were not entered tinted. The homes are the first of the seeds that are not used for tuning, "
    text += "not chosen; robot `pioneer1.yaml`. The share known is that of the places for the robot's centre.\n\n"
    text += command + "\n\n"
    rooms, entered = (sum(row["home"][key] for row in ended) for key in ("rooms", "entered"))
    area = sum(row["home"]["area_m2"] for row in ended)
    known = sum(row["home"]["area_m2"] * row["home"]["known_ratio"] for row in ended)
    successes = sum(row["home"]["success"] for row in ended)
    text += f"{len(ended)} homes: {entered} of {rooms} rooms entered, {known / area:.3f} of {area:.0f} m2 known, "
    text += f"{successes} ended with success. "
    if len(ended) < len(rows):
        text += f"{len(rows) - len(ended)} of the {len(rows)} homes were not run to their end. "
    text += "[More about homes](exploring.md#homes).\n"
    for row in ended:
        name = f"home_{row['seed']}.png"
        shutil.copy(folder / f"seed_{row['seed']}" / "map.png", docs / "pictures" / name)
        text += f"\n## Home {row['seed']}\n\n![Home {row['seed']}](pictures/{name})\n\n{caption(row)}\n"
    (docs / "gallery.md").write_text(text)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
