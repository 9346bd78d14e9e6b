#!/usr/bin/env python3
"""How long those wait who ask `cairn plan --serve`, and how many answers a second there are.

    python3 tests/bench/serve_clients.py build/release/bin/cairn MAP.cairn [SECONDS]

1, 8 and 64 clients, each with a connection of its own, ask between random places among the map's landmarks, each as soon
as it has its answer. Beside it: the same questions by `--queries`, and one a process.
"""
import json
import os
import random
import socket
import subprocess
import sys
import tempfile
import threading
import time

CAIRN, MAP = sys.argv[1:3]
SECONDS = float(sys.argv[3]) if len(sys.argv) > 3 else 10.0


def questions():
    info = json.loads(subprocess.run([CAIRN, "map", "info", MAP, "--json"], capture_output=True, text=True,
                                     check=True).stdout)
    ids = sorted(landmark for cluster in info["clusters"] if cluster["level"] == 1 for landmark in cluster["landmarks"])
    draw = random.Random(1)
    return [dict(zip(("from", "to"), draw.sample(ids, 2))) for _ in range(500)]


def client(path, lines, end_s, waits, outcomes):
    connection = socket.socket(socket.AF_UNIX)
    connection.connect(path)
    stream = connection.makefile("rw")
    while time.monotonic() < end_s:
        begin_s = time.monotonic()
        stream.write(random.choice(lines))
        stream.flush()
        answer = json.loads(stream.readline())
        waits.append(time.monotonic() - begin_s)
        outcomes.append(answer.get("outcome", answer.get("error", "?")))


def row(name, waits, seconds):
    waits = sorted(waits)
    at = lambda share: 1e3 * waits[min(len(waits) - 1, int(share * len(waits)))]
    print(f"| {name} | {len(waits) / seconds:.0f} | {at(0.5):.1f} | {at(0.95):.1f} | {at(0.99):.1f} | {1e3 * waits[-1]:.0f} |",
          flush=True)


def main():
    asked = questions()
    lines = [json.dumps(question) + "\n" for question in asked]
    print("| who asks | answers a second | median ms | 95 % | 99 % | longest |\n|---|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "plans.sock")
        server = subprocess.Popen([CAIRN, "plan", MAP, "--serve", path], stdout=subprocess.PIPE, text=True)
        server.stdout.readline()
        for warm in lines[:20]:
            client(path, [warm], time.monotonic() + 0.001, [], [])
        for count in (1, 8, 64):
            waits, outcomes = [], []
            end_s = time.monotonic() + SECONDS
            threads = [threading.Thread(target=client, args=(path, lines, end_s, waits, outcomes)) for _ in range(count)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            row(f"{count} client{'s' if count > 1 else ''}", waits, SECONDS)
            others = sorted(set(outcomes) - {"solved"})
            if others:
                print(f"not solved: {others}", file=sys.stderr)
        server.terminate()
        server.wait()
        file = os.path.join(folder, "queries.jsonl")
        with open(file, "w") as out:
            out.writelines(lines)
        begin_s = time.monotonic()
        subprocess.run([CAIRN, "plan", MAP, "--queries", file, "--json"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        print(f"| `--queries`, one process | {len(lines) / (time.monotonic() - begin_s):.0f} | | | | |")
    waits = []
    for question in asked[:20]:
        begin_s = time.monotonic()
        subprocess.run([CAIRN, "plan", MAP, "--from", question["from"], "--to", question["to"], "--json"],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        waits.append(time.monotonic() - begin_s)
    row("a process a question", waits, sum(waits))


main()
