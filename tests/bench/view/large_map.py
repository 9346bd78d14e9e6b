#!/usr/bin/env python3
"""A map for docs/results/view.md: 4000 x 4000 cells of rooms with clutter, 10,000 places, 19,800 routes.

large_map.py FOLDER: writes large.pgm with large.yaml (map_server), and large.geojson (Nav2 routes).
"""
import json
import pathlib
import random
import sys

SIDE, ROOM, PLACES = 4000, 80, 100  # cells; places a row


def grid(random_):
    """Rows of bytes: 255 free, 0 occupied, 205 unknown."""
    rows = [bytearray([255]) * SIDE for _ in range(SIDE)]

    def fill(x, y, width, height, value):
        for row in rows[y:y + height]:
            row[x:min(x + width, SIDE)] = bytes([value]) * (min(x + width, SIDE) - x)

    for wall in range(0, SIDE, ROOM):
        fill(0, wall, SIDE, 2, 0)
        fill(wall, 0, 2, SIDE, 0)
    for y in range(0, SIDE, ROOM):
        for x in range(0, SIDE, ROOM):
            door = random_.randrange(10, ROOM - 20)
            fill(x + door, y, 20, 2, 255)
            fill(x, y + door, 2, 20, 255)
    for _ in range(60000):
        fill(random_.randrange(SIDE - 4), random_.randrange(SIDE - 4), 3, 3, 0)
    for _ in range(300):
        fill(random_.randrange(SIDE - 100), random_.randrange(SIDE - 100), 100, 100, 205)
    return rows


def feature(geometry, coordinates, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": geometry, "coordinates": coordinates}}


def routes():
    places = [feature("Point", [1 + 2 * (i % PLACES), 1 + 2 * (i // PLACES)], id=i, frame="map")
              for i in range(PLACES * PLACES)]
    edges = []
    for i in range(PLACES * PLACES):
        for to in ([i + 1] if i % PLACES < PLACES - 1 else []) + ([i + PLACES] if i < PLACES * (PLACES - 1) else []):
            edges.append(feature("MultiLineString", [], id=2 * PLACES * PLACES + len(edges), startid=i, endid=to))
    return {"type": "FeatureCollection", "features": places + edges}


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    cells = b"".join(bytes(row) for row in grid(random.Random(1)))
    (folder / "large.pgm").write_bytes(f"P5\n{SIDE} {SIDE}\n255\n".encode() + cells)
    (folder / "large.yaml").write_text("image: large.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                       "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
    (folder / "large.geojson").write_text(json.dumps(routes()))


main()
