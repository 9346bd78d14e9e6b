#!/usr/bin/env bash
# Unpacks the Debian package and lets its program run the office mission: package_smoke.sh FILE.deb
# Only its own root is written to, so that it can run beside an installed Cairn and without rights.
set -eu
package=$(realpath "$1")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
dpkg-deb -x "$package" "$root"
cd "$root"
mkdir elsewhere
cd elsewhere
"$root/usr/bin/cairn" --version
[ "$("$root/usr/bin/cairn" --version)" = "cairn $(dpkg-deb -f "$package" Version)" ]
"$root/usr/bin/cairn" run "$root/usr/share/cairn/config/missions/office.yaml" --out out
"$root/usr/bin/cairn" map check out/office.cairn
"$root/usr/bin/cairn" plugins new detector my_detector >/dev/null
if grep -rlI "$(dirname "$package")" "$root/usr"; then
  echo "FAILED: the files above name the folder that the package was built in"
  exit 1
fi
echo "package: $(basename "$package") runs the office mission; it needs: $(dpkg-deb -f "$package" Depends)"
