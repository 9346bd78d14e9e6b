"""A detector of Cairn: round pillars of one diameter, by the ring that they leave in the map."""
import math

import numpy as np

SURE = 0.62  # log-odds, nat: beyond it a cell is occupied, below its negative free


class RoundPillars:
    def __init__(self, context, category="pillar", diameter_m=0.5, tolerance_m=0.3, tau_match=0.9):
        self.category = category
        self.radius_m = diameter_m / 2
        self.ground_m = self.radius_m + tolerance_m / 2
        self.tau_match = tau_match
        self.angles = [2 * math.pi * i / 16 for i in range(16)]

    def detect(self, grid, changes):
        """A list of {category, pose, degree}: the pillars whose surroundings have changed."""
        reach = math.ceil(self.ground_m / grid.cell_m) + 3
        rows, columns = [(begin - reach, end + reach) for begin, end in changes.box]
        degrees = self.degrees(grid, rows, columns, reach)
        found = []
        while degrees.size and degrees.max() > self.tau_match:
            row, column = self.middle_of_best(degrees)
            x_m, y_m = grid.centre_of(rows[0] + round(row), columns[0] + round(column))
            found.append({"category": self.category, "pose": (x_m, y_m), "degree": float(degrees.max())})
            degrees[max(0, round(row) - reach):round(row) + reach + 1,
                    max(0, round(column) - reach):round(column) + reach + 1] = 0
        return found

    def degrees(self, grid, rows, columns, reach):
        """How like the middle of a pillar each cell is.

        It is the lesser of how much of the ring is occupied and how much of the ground around it is free.
        """
        log_odds = known(grid, (rows[0] - reach, rows[1] + reach), (columns[0] - reach, columns[1] + reach))
        occupied, free = log_odds > SURE, log_odds < -SURE
        height, width = rows[1] - rows[0], columns[1] - columns[0]

        def seen_from_each(cells, distance, angle):
            down = reach + round(distance * math.sin(angle))
            right = reach + round(distance * math.cos(angle))
            return cells[down:down + height, right:right + width]

        ring = np.zeros((height, width), np.int16)
        around = np.zeros((height, width), np.int16)
        radius, ground = self.radius_m / grid.cell_m, self.ground_m / grid.cell_m
        for angle in self.angles:
            # An echo blurs the ring by a cell.
            ring += seen_from_each(occupied, radius, angle) | seen_from_each(occupied, radius - 1, angle)
            around += seen_from_each(free, ground + 1, angle)
        return np.minimum(ring, around) / len(self.angles)

    def middle_of_best(self, degrees):
        """(row, column): several cells beside each other may be equally good."""
        best = np.argwhere(degrees == degrees.max())
        near = best[np.abs(best - best[0]).max(axis=1) <= 4]
        return near.mean(axis=0)


def known(grid, rows, columns):
    """The log-odds between these rows and columns, which may lie beyond the map: there they are 0, unknown."""
    inside = grid.part(rows, columns).log_odds()
    whole = np.zeros((rows[1] - rows[0], columns[1] - columns[0]), np.float32)
    row, column = max(0, -rows[0]), max(0, -columns[0])
    whole[row:row + inside.shape[0], column:column + inside.shape[1]] = inside
    return whole
