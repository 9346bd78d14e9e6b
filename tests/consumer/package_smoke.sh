#!/usr/bin/env bash
# Unpacks the Debian packages, lets the program run the office mission and Python look at its map:
# package_smoke.sh CAIRN.deb [PYTHON3_CAIRN.deb]
# Only its own root is written to, so that it can run beside an installed Cairn and without rights.
set -eu
package=$(realpath "$1")
python_package=${2:+$(realpath "$2")}
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
dpkg-deb -x "$package" "$root"
[ -z "$python_package" ] || dpkg-deb -x "$python_package" "$root"
cd "$root"
mkdir elsewhere
cd elsewhere
"$root/usr/bin/cairn" --version
[ "$("$root/usr/bin/cairn" --version)" = "cairn $(dpkg-deb -f "$package" Version)" ]
"$root/usr/bin/cairn" run "$root/usr/share/cairn/config/missions/office.yaml" --out out
"$root/usr/bin/cairn" map check out/office.cairn
"$root/usr/bin/cairn" plugins new detector my_detector >/dev/null
if [ -n "$python_package" ]; then
  PYTHONPATH="$root/usr/lib/python3/dist-packages" /usr/bin/python3 -c '
import cairn
map = cairn.load("out/office.cairn")
plan = map.plan((0.6, 0.6), "nearest square")
assert plan.solved and len(map.landmarks) > 0 and map.grid.probability().max() > 0.9, plan
print("python3-cairn:", map)'
fi
if grep -rlI "$(dirname "$package")" "$root/usr"; then
  echo "FAILED: the files above name the folder that the package was built in"
  exit 1
fi
echo "package: $(basename "$package") runs the office mission; it needs: $(dpkg-deb -f "$package" Depends)"
