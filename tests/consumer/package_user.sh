#!/usr/bin/env bash
# What a user of the installed library does without our CMake functions: package_user.sh PREFIX FOLDER
# Every installed header compiles with nothing but its own folder and Eigen; a program links by
# pkg-config; one of another version is refused by find_package, and so is an unknown component.
set -eu
prefix=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig

(cd "$prefix/include/cairn" && find maps framework -name '*.hpp' | sort) | sed 's/.*/#include "&"/' >all_headers.hpp
cat all_headers.hpp - >user.cpp <<'CODE'
#include <iostream>
int main() {
  cairn::OccupancyGrid grid(0.05);
  grid.set_log_odds({1, 2}, 500);
  std::cout << cairn::known_ratio(grid) << " " << cairn::text_of(cairn::this_abi_stamp()) << "\n";
}
CODE
c++ -std=c++20 -O0 -DNDEBUG user.cpp $(pkg-config --cflags --libs cairn) -Wl,-rpath,"$prefix/lib" -o user
./user | grep '^1 cairn '
[ "cairn $(pkg-config --modversion cairn)" = "$("$prefix/bin/cairn" --version)" ]

# The exported targets carry what users need and none of our own flags.
if grep -nE -- '-W[a-z]|private_options|fsanitize|march|ffast-math' "$prefix"/lib/cmake/cairn/*Targets*.cmake; then
  echo "FAILED: the lines above should not be exported"
  exit 1
fi

# refused TEXT ARGUMENTS: find_package(cairn ARGUMENTS) fails and says TEXT.
refused() {
  local text=$1
  shift
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(user CXX)\nfind_package(cairn %s)\n' "$*" >CMakeLists.txt
  if cmake -S . -B refused -DCMAKE_PREFIX_PATH="$prefix" >refused.log 2>&1; then
    echo "FAILED: find_package(cairn $*) was not refused"
    exit 1
  fi
  tr '\n' ' ' <refused.log | tr -s ' ' | grep -qF "$text" || { cat refused.log; exit 1; }
}
refused 'cairn has no component "framwork"; it has framework and conformance' REQUIRED COMPONENTS framwork
refused 'compatible with requested version "99.0"' 99.0 REQUIRED
