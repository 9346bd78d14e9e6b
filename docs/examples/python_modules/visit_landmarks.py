"""A step of a mission: to each landmark of the map once, always the nearest next."""
import math


class VisitLandmarks:
    def __init__(self, context, category=None, speed_mps=0.25, patience_s=10.0):
        self.category = category
        self.speed_mps = speed_mps
        self.patience_s = patience_s
        self.seen = set()    # ids of those that were tried
        self.visited = []    # labels
        self.path = None     # to self.target
        self.target = None
        self.blocked_s = None

    def tick(self, world, ask):
        if self.path is None and not self.choose(world, ask):
            return "success", "visited " + (", ".join(self.visited) or "none")
        if self.path is None:
            return "running", f"no path to {self.target.label}"
        state, left_m = ask.follow(self.path, speed_mps=self.speed_mps)
        if state == "arrived":
            self.visited.append(self.target.label)
            self.path = None
        elif state == "blocked" and self.has_lost_patience(world.time_s):
            ask.report(f"the path to {self.target.label} is blocked")
            self.path = None
        if state == "following":
            self.blocked_s = None
        return "running", f"{left_m:.1f} m to {self.target.label}"

    def choose(self, world, ask):
        """The next landmark and the path to it, None where there is no path; False: all were tried."""
        open_ones = [landmark for landmark in world.landmarks
                     if landmark.id not in self.seen and self.category in (None, landmark.category)]
        if not open_ones:
            return False
        self.target = min(open_ones, key=lambda landmark: math.dist(landmark.approach_pose[:2], world.pose[:2]))
        self.seen.add(self.target.id)
        plan = ask.plan(to=self.target)
        self.path = plan.path if plan.solved else None
        self.blocked_s = None
        return True

    def has_lost_patience(self, time_s):
        if self.blocked_s is None:
            self.blocked_s = time_s
        return time_s - self.blocked_s > self.patience_s
