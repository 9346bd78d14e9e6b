#!/usr/bin/env bash
# Program, libraries and modules of a release build are hardened: hardened.sh BUILD_FOLDER
set -u
cd "$1"
status=0

fault() {
  echo "$1: $2"
  status=1
}

for file in bin/cairn lib/libcairn_*.so lib/cairn/*.so; do
  readelf -lW "$file" | grep -q GNU_RELRO || fault "$file" "addresses stay writable (no GNU_RELRO)"
  readelf -dW "$file" | grep -qE 'BIND_NOW|Flags:.*NOW' || fault "$file" "symbols are bound late (no BIND_NOW)"
  readelf -lW "$file" | grep GNU_STACK | grep -q ' RWE ' && fault "$file" "the stack is executable"
done
readelf -hW bin/cairn | grep -qE 'Type:.*DYN' || fault bin/cairn "has a fixed address (no PIE)"
for file in bin/cairn lib/libcairn_framework.so lib/libcairn_maps.so; do
  nm -D "$file" | grep -q __stack_chk_fail || fault "$file" "has no stack protector"
done
nm -D lib/libcairn_framework.so lib/libcairn_maps.so lib/cairn/*.so | grep -qE ' U __[a-z]+_chk' ||
  fault "libraries" "no call is fortified"
exit $status
