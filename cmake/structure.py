#!/usr/bin/env python3
"""The weight of the product: lines, functions, classes, folders. Needs ctags (package universal-ctags).

    cmake/structure.py [PROJECT]
"""
import collections
import os
import subprocess
import sys

root = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..")


def output_of(*command):
    return subprocess.check_output(command, cwd=root, text=True)


files = [f for f in output_of("git", "ls-files", "*.cpp", "*.hpp").split() if not f.startswith("tests/")]
lines = sum(open(os.path.join(root, f)).read().count("\n") for f in files)
functions = []
members = collections.Counter()
tags = output_of("ctags", "-x", "--_xformat=%K\t%N\t%F\t%n\t%e\t%s", "--fields=+neKs", "--kinds-C++=fm",
                 "--language-force=C++", *files)
for tag in tags.splitlines():
    kind, name, file, begin, end, scope = (tag.split("\t") + [""] * 6)[:6]
    if kind == "function" and end.isdigit():
        functions.append((int(end) - int(begin) + 1, file, name))
    if kind == "member":
        members[(file, scope)] += 1
functions.sort()
folders = collections.Counter(os.path.dirname(f) for f in output_of("git", "ls-files").split() if "/corpus/" not in f)

print(f"product: {lines} lines in {len(files)} files")
for share in (0.5, 0.9, 0.99, 1.0):
    length, file, name = functions[min(len(functions) - 1, int(share * len(functions)))]
    print(f"function, {share:.0%}: {length} lines ({file}: {name})")
for (file, scope), count in members.most_common(5):
    print(f"data members: {count} {scope} ({file})")
for folder, count in folders.most_common(5):
    print(f"files in a folder: {count} {folder}")
