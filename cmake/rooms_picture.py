#!/usr/bin/env python3
"""Draws the rooms of maps/, framework/ and plugins/behaviours/ and what each uses, as the build files say (cairn_add_room ... USES ...).

    cmake/rooms_picture.py > docs/pictures/rooms.svg
    cmake/rooms_picture.py --check    # is that picture today's, and does USES name just what the sources include?

Arrows that follow from others are left out.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = {"maps": "maps", "framework": "framework", "behaviours": "plugins/behaviours"}  # of rooms
WIDTH, HEIGHT, GAP_X, GAP_Y, MARGIN = 128, 34, 22, 44, 24


def read_rooms():
    """{room: the rooms that it uses}, in the order of the build files."""
    rooms = {}
    for folder in FOLDERS.values():
        for file in sorted((ROOT / folder).rglob("CMakeLists.txt")):
            for body in re.findall(r"cairn_add_room\(([^)]*)\)", file.read_text()):
                words = re.sub(r"#[^\n]*", "", body).split()
                uses, section = [], ""
                for word in words[1:]:
                    if word in ("SOURCES", "USES", "PRIVATE"):
                        section = word
                    elif section == "USES" and "_" in word:  # not a whole library
                        uses.append(word)
                rooms[words[0]] = uses
    return rooms


def reached(rooms, room):
    found, todo = set(), list(rooms[room])
    while todo:
        one = todo.pop()
        if one not in found:
            found.add(one)
            todo += rooms[one]
    return found


def direct_uses(rooms, room):
    """Without what another used room uses already."""
    return [used for used in rooms[room] if not any(used in reached(rooms, other) for other in rooms[room])]


def levels_of(uses):
    """Each room right below the lowest of its users, one without users right above what it uses; 0 is the top."""
    def depth(room):
        return 1 + max((depth(user) for user in uses if room in uses[user]), default=-1)

    level = {room: depth(room) for room in uses}
    for room in uses:
        if level[room] == 0 and uses[room]:
            level[room] = min(level[used] for used in uses[room]) - 1
    return level


class Column:
    """One part of the house: its rooms in rows, and arrows between them."""

    def __init__(self, rooms, outer, left, top):
        self.rooms = {room: [used for used in direct_uses(rooms, room) if used.startswith(outer)]
                      for room in rooms if room.startswith(outer)}
        level = levels_of(self.rooms)
        rows = [[r for r in self.rooms if level[r] == row] for row in range(max(level.values()) + 1)]
        across = max(len(row) for row in rows)
        self.left, self.width = left, across * (WIDTH + GAP_X) - GAP_X
        self.at = {}
        for number, row in enumerate(rows):
            start = left + (self.width - len(row) * (WIDTH + GAP_X) + GAP_X) / 2
            users = [self.at[user][0] for user in self.at if len(row) == 1 and row[0] in self.rooms[user]]
            if users:
                start = sum(users) / len(users)
            for i, room in enumerate(row):
                self.at[room] = (start + i * (WIDTH + GAP_X), top + number * (HEIGHT + GAP_Y))
        self.bottom = top + len(rows) * (HEIGHT + GAP_Y) - GAP_Y

    def arrow(self, room, used):
        (x1, y1), (x2, y2) = self.at[room], self.at[used]
        x1, x2, y1 = x1 + WIDTH / 2, x2 + WIDTH / 2, y1 + HEIGHT
        bend = GAP_Y * 0.8
        return f"M{x1:.0f},{y1:.0f} C{x1:.0f},{y1 + bend:.0f} {x2:.0f},{y2 - bend:.0f} {x2:.0f},{y2:.0f}"

    def draw(self, colour):
        for room, uses in self.rooms.items():
            for used in uses:
                yield (f'<path d="{self.arrow(room, used)}" fill="none" stroke="#777" stroke-width="1.2" '
                       'marker-end="url(#tip)"/>')
        for room, (x, y) in self.at.items():
            yield (f'<rect x="{x:.0f}" y="{y:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="5" fill="{colour}" '
                   'stroke="#555"/>')
            yield (f'<text x="{x + WIDTH / 2:.0f}" y="{y + HEIGHT / 2 + 4:.0f}" text-anchor="middle">'
                   f'{room.split("_", 1)[1].replace("_", " ")}</text>')


def draw(rooms):
    columns, left = [], MARGIN
    for outer in FOLDERS:
        columns.append(Column(rooms, f"{outer}_", left, 2 * MARGIN))
        left += columns[-1].width + 90
    width = left - 90 + MARGIN
    height = max(column.bottom for column in columns) + MARGIN
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
           'font-family="DejaVu Sans, sans-serif" font-size="13">',
           '<defs><marker id="tip" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto">'
           '<path d="M0,0 L8,4 L0,8 z" fill="#777"/></marker></defs>',
           '<rect width="100%" height="100%" fill="white"/>']
    for column, folder, colour in zip(columns, FOLDERS.values(), ("#dbe9f6", "#fdebd0", "#e2f0d9")):
        out.append(f'<text x="{column.left + column.width / 2:.0f}" y="{MARGIN}" text-anchor="middle" '
                   f'font-size="16">{folder}/</text>')
        out += column.draw(colour)
    y = 2 * MARGIN + HEIGHT / 2
    for used, user in zip(columns, columns[1:]):
        out.append(f'<path d="M{user.left:.0f},{y:.0f} L{used.left + used.width + 24:.0f},{y:.0f}" '
                   'stroke="#777" stroke-width="3" marker-end="url(#tip)"/>')
    return "\n".join(out + ["</svg>", ""])


def included_rooms(room):
    outer, name = room.split("_", 1)
    folder = ROOT / FOLDERS[outer] / name
    text = "".join(file.read_text() for ending in ("hpp", "cpp") for file in folder.rglob(f"*.{ending}"))
    parts = [part for part in FOLDERS if outer != "behaviours" or part == outer]  # a module uses the framework whole
    return {f"{part}_{name}" for part in parts
            for name in re.findall(rf'#include "{FOLDERS[part]}/(\w+)/', text)} - {room}


def faults():
    rooms = read_rooms()
    if (ROOT / "docs/pictures/rooms.svg").read_text() != draw(rooms):
        yield "docs/pictures/rooms.svg is not of today's build files: cmake/rooms_picture.py > docs/pictures/rooms.svg"
    for room, uses in rooms.items():
        included = included_rooms(room)
        for used in sorted(included - set(uses)):
            yield f"{room} includes {used}, which its USES does not name"
        for used in sorted(set(uses) - included):
            yield f"{room} names {used} in its USES and includes nothing of it"


if __name__ == "__main__":
    if "--check" in sys.argv:
        found = list(faults())
        print("\n".join(found))
        sys.exit(1 if found else 0)
    sys.stdout.write(draw(read_rooms()))
