#!/usr/bin/env python3
"""How long the wheels turn after each fault, at each stage: the table of docs/hardening.md.

    python3 tests/bench/stop_table.py build/release [CASE ...]

Each case starts a simulated base as a process of its own, in wall-clock time, and the program that drives it straight
on at 0.3 m/s. CAIRN_STOP_ROBOT and CAIRN_STOP_MPS: another robot of config/robots, and its speed. A module
(tests/plugin/failing.cpp) or this script makes the fault; the base's log shows what was ordered of the wheels and how
they turned. CAIRN_STOP_MISSION holds further settings of the mission, to compare them. Needs the targets cairn,
simulated_robot, remote_base, odometry_compass, muriel, failing.
"""
import json
import os
import pathlib
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv[1]).resolve()
CAIRN = str(BUILD / "bin" / "cairn")
BASE = os.environ.get("CAIRN_BASE_PROGRAM", CAIRN)
PLUGINS = os.environ.get("CAIRN_PLUGIN_FOLDERS", str(BUILD / "tests" / "plugin" / "failing")).split(":")
AFTER_S = 4.0
ROBOT = os.environ.get("CAIRN_STOP_ROBOT", "pioneer1")
SPEED_MPS = float(os.environ.get("CAIRN_STOP_MPS", "0.3"))
STANDS_MPS = 0.005
WATCHDOG_S = 3

WRAPPED = {
    "sensor": ("sensor", "failing_sensor", "{plugin: remote_base, socket: ../link.sock, reconnect_s: 2}"),
    "drive": ("sensor", "failing_drive", "{plugin: remote_base, socket: ../link.sock, reconnect_s: 2}"),
    "localizer": ("localizer", "failing_localizer", "{plugin: odometry_compass}"),
    "mapper": ("map", "failing_map", "{plugin: muriel}"),
    "detector": ("detector", "failing_detector", "{plugin: muriel}"),
    "planner": ("planner", "failing_planner", "{plugin: muriel}"),
    "controller": ("controller", "failing_controller", "{plugin: muriel}"),
    "behaviour": ("behaviour", "straight", "{plugin: muriel}"),
}
STAGES = ["sensor", "localizer", "mapper", "detector", "planner", "controller", "behaviour", "drive"]
FAULTS = {
    "throw": "throw", "hang": "hang", "hang of 1.5 s": "stall", "crash (SIGSEGV)": "crash", "abort()": "abort",
    "exit()": "exit", "_exit()": "_exit", "absurd value": "absurd", "growth of memory": "growth",
}
NO_ABSURD = {"mapper", "drive"}  # nothing that they return can be absurd


class Link:
    """Between the program and its base: may be cut, be silent, or change what the base says."""

    def __init__(self, folder):
        self.folder = folder
        self.base = str(folder / "base.sock")
        self.path = str(folder / "link.sock")
        self.change = lambda seen: seen
        self.is_silent = False
        self.is_cut = False
        self.pairs = []
        self.server = socket.socket(socket.AF_UNIX)
        self.server.bind(self.path)
        self.server.listen()
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            try:
                client, _ = self.server.accept()
            except OSError:
                return
            if self.is_cut:
                client.close()
                continue
            base = socket.socket(socket.AF_UNIX)
            try:
                base.connect(self.base)
            except OSError:
                client.close()
                continue
            self.pairs = [client, base]
            threading.Thread(target=self.forward, args=(client, base, False), daemon=True).start()
            threading.Thread(target=self.forward, args=(base, client, True), daemon=True).start()

    def forward(self, source, target, from_base):
        text = b""
        try:
            while got := source.recv(65536):
                text += got
                *lines, text = text.split(b"\n")
                for line in lines:
                    if from_base and self.is_silent:
                        continue
                    if from_base and line:
                        line = json.dumps(self.change(json.loads(line))).encode()
                    target.sendall(line + b"\n")
        except OSError:
            pass
        for end in (source, target):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def cut(self):
        self.is_cut = True
        for end in self.pairs:
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass


def mission_text(stage, fault, more):
    parts = {
        "sensor": "sensor: {plugin: remote_base, socket: ../link.sock, reconnect_s: 2}",
        "localizer": "localizer: {plugin: odometry_compass}",
        "map": "map: {plugin: muriel}",
        "behaviour": f"steps: [straight: {{speed_mps: {SPEED_MPS}, after_s: {AFTER_S}}}]",
    }
    if fault is not None and stage in WRAPPED:
        key, name, inner = WRAPPED[stage]
        settings = f"fault: {fault}, after_s: {AFTER_S}, note: ../note.txt"
        asks = {"planner": "plan", "controller": "control"}.get(stage)
        if key == "behaviour":
            parts[key] = f"steps: [straight: {{speed_mps: {SPEED_MPS}, {settings}}}]"
        else:
            parts[key] = f"{key}: {{plugin: {name}, of: {inner}, {settings}}}"
        if asks:
            planner_first = ", after_s: %g" % (AFTER_S if asks == "plan" else 0)
            parts["behaviour"] = f"steps: [straight: {{speed_mps: {SPEED_MPS}, asks: {asks}{planner_first}}}]"
        if stage == "planner":
            parts["planner"] = parts["planner"].replace(f"after_s: {AFTER_S}", "after_s: 0")
    return (f"mission: stop\nrobot: {SOURCE}/config/robots/{ROBOT}.yaml\nstart: {{at_m: [1, 2], angle_deg: 0}}\n"
            f"watchdog_s: {WATCHDOG_S}\nat_most_s: 12\nautosave: {{every_s: 1}}\n" + "\n".join(parts.values()) + "\n"
            + os.environ.get("CAIRN_STOP_MISSION", "") + "\n" + more)


def ticks_of(log):
    ticks = []
    for line in log.read_text().splitlines()[1:]:
        values = line.split(",")
        if len(values) == 6 and values[4]:
            ticks.append((float(values[0]), float(values[2]), float(values[4])))
    return ticks


def wait(condition, at_most_s):
    end = time.monotonic() + at_most_s
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    return None


def map_after(out):
    found = []
    for file in sorted(out.glob("*.cairn")):
        check = subprocess.run([CAIRN, "map", "check", str(file)], capture_output=True, text=True)
        name = "autosave" if "autosave" in file.name else "map"
        found.append(f"{name} {'loads' if check.returncode == 0 else 'is damaged'}")
    return ", ".join(found) or "none"


class Case:
    def __init__(self, fault, stage, module_fault=None, act=None, more="", limits=(), drives_on=False):
        self.fault, self.stage, self.module_fault, self.act = fault, stage, module_fault, act
        self.more, self.limits, self.drives_on = more, limits, drives_on

    def run(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="cairn_stop_"))
        (folder / "m").mkdir()
        (folder / "world.yaml").write_text("bounds_m: [[0, 0], [100, 4]]\n")
        base_mission = folder / "base.yaml"
        base_mission.write_text(
            f"mission: base\nrobot: {SOURCE}/config/robots/{ROBOT}.yaml\nworld: world.yaml\n"
            "start: {at_m: [1, 2], angle_deg: 0}\nsensor: {plugin: simulated_robot}\n"
            "localizer: {plugin: odometry_compass}\nmap: {plugin: muriel}\nsteps: [wait: 1]\n")
        (folder / "m" / "mission.yaml").write_text(mission_text(self.stage, self.module_fault, self.more))
        log = folder / "base.csv"
        arguments = [BASE, "base", str(base_mission), "--listen", str(folder / "base.sock"), "--log", str(log)]
        with open(folder / "base.txt", "w") as base_out, open(folder / "mission.txt", "w") as mission_out:
            base = subprocess.Popen(arguments, stdout=base_out, stderr=subprocess.STDOUT)
            wait(lambda: log.exists(), 30)
            link = Link(folder)
            mission = subprocess.Popen(
                [CAIRN, "run", str(folder / "m" / "mission.yaml"), "--out", str(folder / "out")]
                + [argument for plugins in PLUGINS for argument in ("--plugins", plugins)],
                stdout=mission_out, stderr=subprocess.STDOUT,
                preexec_fn=lambda: [resource.setrlimit(what, (size, size)) for what, size in self.limits] or None)
            try:
                row = self.measure(folder, log, link, mission)
            finally:
                for process in (mission, base):
                    if process.poll() is None:
                        process.kill()
                    process.wait()
                link.server.close()
        if os.environ.get("CAIRN_KEEP"):
            print(folder, file=sys.stderr)
        else:
            shutil.rmtree(folder)
        return row

    def measure(self, folder, log, link, mission):
        note = folder / "note.txt"
        driving = wait(lambda: any(v > 0.95 * SPEED_MPS for _, _, v in ticks_of(log)[-3:]), 60)
        if not driving:
            return ["?", "?", "never drove: " + (folder / "mission.txt").read_text()[-300:], "?"]
        if self.act:
            time.sleep(1.0)
            begin_s = time.monotonic()
            self.act(link, mission)
        else:
            begin_s = wait(lambda: note.exists() and note.read_text().strip(), 60)
            begin_s = float(begin_s) if begin_s else None
        if begin_s is None:
            begin_s = time.monotonic()

        def first(column, below):
            for tick in ticks_of(log):
                if tick[0] > begin_s and abs(tick[column]) < below:
                    return tick[0] - begin_s
            return None

        stands = None if self.drives_on else wait(lambda: first(2, STANDS_MPS), 20)
        ordered = None if self.drives_on else first(1, 1e-9)
        if self.fault.startswith("SIGSTOP"):
            mission.send_signal(signal.SIGCONT)
        drives_on = ""
        if stands is not None:
            again = wait(lambda: mission.poll() is None and
                         any(t > begin_s + stands and v > 0.5 * SPEED_MPS for t, _, v in ticks_of(log)), 3)
            drives_on = "goes on by itself" if again else ""
        elif mission.poll() is None:
            drives_on = "drives on"
        try:
            mission.wait(20)
        except subprocess.TimeoutExpired:
            mission.send_signal(signal.SIGINT)
            mission.wait(20)
        text = (folder / "mission.txt").read_text()
        outcome = [line.split("outcome", 1)[1].strip() for line in text.splitlines() if line.startswith("  outcome")]
        words = [line for line in text.splitlines() if line.startswith("cairn: ") or "the robot was stopped" in line]
        said = [" ".join(w.split()).split(" s ", 1)[-1] for w in words[:1]] if drives_on or not outcome else []
        ends = outcome if drives_on != "goes on by itself" else []
        listeners = [" ".join(line.split()).split(" s ", 1)[-1] for line in text.splitlines() if "listener failed" in line or "autosave failed" in line]
        sentence = "; ".join([drives_on] * bool(drives_on) + said + ends + listeners[:1])
        if not sentence:
            sentence = "ended by the system"
        sentence = sentence.replace(str(folder / "link.sock"), "PATH").replace(str(folder) + "/", "").replace("|", "/")
        number = lambda s: "–" if s is None else f"{s:.2f}"
        return [number(ordered), number(stands), sentence, map_after(folder / "out")]


def cases():
    for fault, key in FAULTS.items():
        for stage in STAGES:
            if key == "absurd" and stage in NO_ABSURD:
                continue
            limits = [(resource.RLIMIT_AS, 1 << 30)] if key == "growth" else []
            yield Case(fault, stage, key, limits=limits)
    yield Case("the odometry leaps by 9 m a tick", "sensor", "leap")
    yield Case("a million detections at once", "detector", "flood")
    yield Case("SIGSTOP, SIGCONT", "host", act=lambda link, mission: mission.send_signal(signal.SIGSTOP))
    yield Case("kill -9", "host", act=lambda link, mission: mission.send_signal(signal.SIGKILL))
    for name in ("SIGTERM", "SIGHUP", "SIGQUIT", "SIGALRM"):
        yield Case(name, "host", act=lambda link, mission, name=name: mission.send_signal(getattr(signal, name)))
    yield Case("SIGINT twice", "host", act=lambda link, mission: [mission.send_signal(signal.SIGINT), time.sleep(0.01),
                                                                  mission.send_signal(signal.SIGINT)])
    yield Case("SIGPIPE", "host", act=lambda link, mission: mission.send_signal(signal.SIGPIPE), drives_on=True)
    yield Case("full disk", "host", act=lambda link, mission: None, more="record: stop.log\n",
               limits=[(resource.RLIMIT_FSIZE, 8192)], drives_on=True)
    yield Case("unplugged: the connection is cut", "sensor", act=lambda link, mission: link.cut())
    yield Case("unplugged: the base sends nothing", "sensor", act=lambda link, mission: setattr(link, "is_silent", True))
    yield Case("unplugged: no ranges", "sensor", act=lambda link, mission: setattr(
        link, "change", lambda seen: {**seen, "ranges": []}))

    def clock(by_s):
        return lambda link, mission: setattr(link, "change", lambda seen: {**seen, "stamp_s": seen["stamp_s"] + by_s})
    yield Case("the base's clock steps 1 h ahead", "sensor", act=clock(3600.0), drives_on=True)
    yield Case("the base's clock steps 1 h back", "sensor", act=clock(-3600.0), drives_on=True)
    yield Case("the base's clock stands", "sensor", act=lambda link, mission: setattr(
        link, "change", lambda seen: {**seen, "stamp_s": 5.0}))
    yield Case("the base sends what is no observation", "sensor", act=lambda link, mission: setattr(
        link, "change", lambda seen: {"stamp_s": "noon"}))


def main():
    wanted = sys.argv[2:]
    print("| fault | stage | stop ordered after, s | wheels stand after, s | the mission | map afterwards |")
    print("|---|---|---|---|---|---|")
    for case in cases():
        if wanted and not any(part in f"{case.fault} / {case.stage}" for part in wanted):
            continue
        print("| " + " | ".join([case.fault, case.stage, *case.run()]) + " |", flush=True)


main()
