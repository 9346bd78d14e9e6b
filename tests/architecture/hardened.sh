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

# What another file can see of it: of a module its one function and its stamp, of the program nothing, of a library what
# is Cairn's own.
exported() {
  nm -D --defined-only "$1" | awk '{ print $3 }' | sort
}
for file in lib/cairn/*.so; do
  [ "$(exported "$file" | tr '\n' ' ')" = "cairn_abi_stamp cairn_register_module " ] ||
    fault "$file" "exports other names than its function and its stamp: $(exported "$file" | tr '\n' ' ' | cut -c 1-200)"
done
[ -z "$(exported bin/cairn)" ] || fault bin/cairn "exports $(exported bin/cairn | tr '\n' ' ' | cut -c 1-200)"
for file in lib/libcairn_*.so; do
  strange=$(exported "$file" | grep -vE '^_ZNK?5cairn|^_ZT[VITSC]N5cairn|^_ZT[hvc].*_NK?5cairn' | tr '\n' ' ' | cut -c 1-200)
  [ -z "$strange" ] || fault "$file" "exports $strange"
  [ -n "$(exported "$file")" ] || fault "$file" "exports nothing"
done
exit $status
