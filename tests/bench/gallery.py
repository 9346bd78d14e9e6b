#!/usr/bin/env python3
"""The page of homes as maps: a picture a run and its figures, in the order of the seeds.

    build/release/bin/cairn experiment config/experiments/homes.yaml --out out/gallery --set seeds.count=10 \\
        --set "variants=[{name: pioneer1, robot: config/robots/pioneer1.yaml}]" --set baseline=pioneer1
    tests/bench/gallery.py out/gallery docs/results

Writes gallery.md, and the pictures to pictures/ beside it. Runs that did not end are left out and counted. Needs
nothing but Python.
"""
import json, pathlib, struct, sys, zlib


def caption(row):
    home = row["home"]
    to_90 = f"{home['known_90_s']:.0f} s" if "known_90_s" in home else "never"
    return (
        f"{home['entered']} of {home['rooms']} rooms entered; {home['known_ratio']:.3f} of {home['area_m2']:.1f} m2 known, "
        f"90 % after: {to_90}; {row['distance_m']:.0f} m and {row['time_s']:.0f} s in all; contacts: {home['contacts']}, "
        f"fast: {home['fast_contacts']}. Ended with {'success' if home['success'] else 'failure'}: \"{home['end']}\".")


def write_small(source, target):
    """The PNG in at most 216 colours."""
    data = source.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    if (depth, colours) != (8, 2):
        raise SystemExit(f"{source}: is not RGB of 8 bits")
    raw, line, palette, rows = zlib.decompress(packed), bytearray(3 * width), {}, bytearray()
    for y in range(height):
        kind, row = raw[y * (3 * width + 1)], bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        for i in range(3 * width):
            a, b, c = (row[i - 3] if i > 2 else 0), line[i], (line[i - 3] if i > 2 else 0)
            if kind == 4:
                p = a + b - c
                add = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            else:
                add = (0, a, b, (a + b) // 2)[kind]
            row[i] = row[i] + add & 255
        line = row
        rows.append(0)
        for i in range(0, 3 * width, 3):
            key = tuple(min(255, (v + 25) // 51 * 51) for v in row[i:i + 3])
            rows.append(palette.setdefault(key, len(palette)))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    target.write_bytes(data[:8] + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) +
                       chunk(b"PLTE", bytes(v for colour in palette for v in colour)) +
                       chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


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
        text += f"{len(rows) - len(ended)} of the {len(rows)} homes were not run to their end: they still ran when the experiment was stopped, so long runs are likelier among them. "
    text += "[More about homes](exploring.md#homes).\n"
    for row in ended:
        name = f"home_{row['seed']}.png"
        write_small(folder / f"seed_{row['seed']}" / "map.png", docs / "pictures" / name)
        text += f"\n## Home {row['seed']}\n\n![Home {row['seed']}](pictures/{name})\n\n{caption(row)}\n"
    (docs / "gallery.md").write_text(text)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
