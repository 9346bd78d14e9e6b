"""A step of a mission: once round a square, to the left, from where the robot stands."""
import math


class DriveSquare:
    def __init__(self, context, side_m=1.0, speed_mps=0.2):
        self.side_m = side_m
        self.speed_mps = min(speed_mps, context.robot.max_v_mps)
        self.max_w_radps = min(1.0, context.robot.max_w_radps)
        self.corners = None  # those still to come

    def tick(self, world, ask):
        x_m, y_m, heading = world.pose
        if self.corners is None:
            self.corners = corners_of(world.pose, self.side_m)
        while self.corners and math.dist(self.corners[0], (x_m, y_m)) < 0.05:
            self.corners.pop(0)
        if not self.corners:
            return "success", "round the square"
        to_x, to_y = self.corners[0]
        error = math.remainder(math.atan2(to_y - y_m, to_x - x_m) - heading, 2 * math.pi)
        turn = max(-self.max_w_radps, min(self.max_w_radps, 2 * error))
        ask.drive(self.speed_mps if abs(error) < 0.2 else 0.0, turn)
        return "running", f"{len(self.corners)} corners to go"


def corners_of(pose, side_m):
    x_m, y_m, heading = pose
    corners = []
    for turn in range(4):
        x_m += side_m * math.cos(heading + turn * math.pi / 2)
        y_m += side_m * math.sin(heading + turn * math.pi / 2)
        corners.append((x_m, y_m))
    return corners
