#!/usr/bin/env bash
# Program, libraries and modules of a release build are hardened: hardened.sh BUILD_FOLDER
set -u
cd "$1"
status=0

fault() {
  echo "$1: $2"
  status=1
}

shopt -s nullglob  # Python's module is not built everywhere
for file in bin/cairn lib/libcairn_*.so lib/cairn/*.so python/cairn/_native*.so; do
  readelf -lW "$file" | grep -q GNU_RELRO || fault "$file" "addresses stay writable (no GNU_RELRO)"
  readelf -dW "$file" | grep -qE 'BIND_NOW|Flags:.*NOW' || fault "$file" "symbols are bound late (no BIND_NOW)"
  # Where its libraries are looked for: an empty or relative element is the folder that the program is started in.
  path=$(readelf -dW "$file" | sed -nE 's/.*\((RUNPATH|RPATH)\).*\[(.*)\]$/\2/p')
  [ -n "$path" ] || fault "$file" "has no path to its libraries"
  printf '%s:' "$path" | tr ':' '\n' | grep -qvE '^(/|\$ORIGIN(/|$))' && fault "$file" "looks for libraries in the current folder: $path"
  readelf -lW "$file" | grep GNU_STACK | grep -q ' RWE ' && fault "$file" "the stack is executable"
done
readelf -hW bin/cairn | grep -qE 'Type:.*DYN' || fault bin/cairn "has a fixed address (no PIE)"
for file in bin/cairn lib/libcairn_*.so lib/cairn/*.so python/cairn/_native*.so; do
  nm -D "$file" | grep -q __stack_chk_fail || fault "$file" "has no stack protector"
  nm -D "$file" | grep -qE ' U __[a-z]+_chk' || fault "$file" "no call is fortified"
done

# What another file can see of it: of a module its one function and its stamp, of Python's module its function, of the
# program nothing, of a library what is Cairn's own.
exported() {
  nm -D --defined-only "$1" | awk '{ print $3 }' | sort
}
for file in lib/cairn/*.so; do
  [ "$(exported "$file" | tr '\n' ' ')" = "cairn_abi_stamp cairn_register_module " ] ||
    fault "$file" "exports other names than its function and its stamp: $(exported "$file" | tr '\n' ' ' | cut -c 1-200)"
done
for file in python/cairn/_native*.so; do
  [ "$(exported "$file")" = PyInit__native ] || fault "$file" "exports $(exported "$file" | tr '\n' ' ' | cut -c 1-200)"
done
[ -z "$(exported bin/cairn)" ] || fault bin/cairn "exports $(exported bin/cairn | tr '\n' ' ' | cut -c 1-200)"
for file in lib/libcairn_*.so; do
  strange=$(exported "$file" | grep -vE '^_ZNK?5cairn|^_ZT[VITSC]N5cairn|^_ZT[hvc].*_NK?5cairn' | tr '\n' ' ' | cut -c 1-200)
  [ -z "$strange" ] || fault "$file" "exports $strange"
  [ -n "$(exported "$file")" ] || fault "$file" "exports nothing"
done
exit $status
