"""Missions in Enki by both roads, and the same missions in Cairn's simulator: for the scripts beside this one."""
import json
import os
import pathlib
import re
import subprocess
import threading
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CONFIG = SOURCE / "config"
MISSIONS = {"ros2": CONFIG / "missions/enki_ros2.yaml", "serial": CONFIG / "missions/enki_pioneer.yaml"}
FIRST_DOMAIN = 100

domains_in_use, domains_lock = set(), threading.Lock()


def free_domain():
    with domains_lock:
        domain = next(d for d in range(FIRST_DOMAIN, 230) if d not in domains_in_use)
        domains_in_use.add(domain)
        return domain


def mission_text(road, settings):
    """The mission of a road (of "serial" for the simulator's), its files by absolute names, with other settings."""
    text = MISSIONS.get(road, MISSIONS["serial"]).read_text().replace("../", f"{CONFIG}/")
    for key, value in settings.items():
        text = re.sub(rf"^{key}:.*$", f"{key}: {value}", text, flags=re.M)
    return text


def last_tick(log):
    """Where Enki's robot is at last, and how often it has touched something."""
    words = log.read_text().splitlines()[-1].split(",")
    return float(words[1]), float(words[2]), int(words[5])


def run_program(build, folder, environment):
    began = time.monotonic()
    with open(folder / "mission.txt", "w") as said:
        mission = subprocess.Popen([str(build / "bin/cairn"), "run", str(folder / "mission.yaml"), "--out",
                                    str(folder / "out")], stdout=said, stderr=subprocess.STDOUT,
                                   env={**os.environ, **environment}, start_new_session=True)
        _, status, used = os.wait4(mission.pid, 0)
        mission.returncode = os.waitstatus_to_exitcode(status)
    report = folder / "out/report.json"
    return {"exit": mission.returncode, "wall_s": time.monotonic() - began, "cpu_s": used.ru_utime + used.ru_stime,
            "report": json.loads(report.read_text()) if report.exists() else {"landmarks": [], "outcome": "none"}}


def run_simulated(build, folder, settings):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "mission.yaml").write_text(mission_text("simulated", {**settings, "sensor": "{plugin: simulated_robot}"}))
    return run_program(build, folder, {})


def run_live(build, road, folder, settings):
    folder.mkdir(parents=True, exist_ok=True)
    domain = free_domain()
    text = mission_text(road, settings).replace("domain: 42", f"domain: {domain}")
    (folder / "mission.yaml").write_text(text)
    link, log, latencies = folder / "line", folder / "wheels.csv", folder / "latencies.csv"
    link.unlink(missing_ok=True)
    log.unlink(missing_ok=True)
    words = {"ros2": ["enki_ros2", folder / "mission.yaml", domain, log, latencies],
             "serial": ["enki_pioneer", folder / "mission.yaml", link, log]}[road]
    # A session of its own: Linux shares the processors out by sessions, and a robot does not wait for its neighbours.
    robot = subprocess.Popen([str(build / "bin" / words[0])] + [str(word) for word in words[1:]],
                             stdout=subprocess.DEVNULL, start_new_session=True)
    try:
        while robot.poll() is None and not (log.exists() if road == "ros2" else link.is_symlink()):
            time.sleep(0.05)
        ended = run_program(build, folder, {"CAIRN_PIONEER": str(link)})
        time.sleep(0.3)
    finally:
        robot.kill()
        robot.wait()
        domains_in_use.discard(domain)
    return {**ended, "at": last_tick(log)}
