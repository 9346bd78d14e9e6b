// How well saved maps of one place find each other, and that those of two places do not:
//     merge_table PLACE=MAP,MAP,... ...
// Every two maps of a place are aligned, the second as it is and in five other frames; all maps of a place must be in
// one frame, as those of a simulation are: that is the truth. Every two of different places are tried as they are.
// Prints a row a place, and one for the different ones.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maps/base/portable_random.hpp"
#include "maps/edit/alignment.hpp"
#include "maps/edit/merge.hpp"

namespace {

using cairn::Pose2;
using cairn::SavedMap;

constexpr int kOtherFrames = 5;

struct Place {
  std::string name;
  std::vector<SavedMap> maps;
};

struct Row {
  int tries = 0;
  int found = 0;
  std::vector<double> errors_m;
  std::vector<double> errors_deg;
  std::vector<double> took_s;
};

std::optional<Place> place_of(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) return std::nullopt;
  Place place{word.substr(0, equals), {}};
  for (std::size_t begin = equals + 1; begin <= word.size();) {
    const std::size_t end = std::min(word.find(',', begin), word.size());
    place.maps.push_back(cairn::load_map(word.substr(begin, end - begin)));
    begin = end + 1;
  }
  return place;
}

// The same map in a frame that lies so in its own.
SavedMap in_other_frame(const SavedMap& map, const Pose2& T_new_old) {
  SavedMap empty;
  empty.grid = cairn::OccupancyGrid(map.grid.cell_m());
  return cairn::merge_maps(empty, map, {T_new_old, 0.4}).map;
}

void align(const SavedMap& a, const SavedMap& b, const Pose2& T_new_old, Row& row) {
  const auto begin = std::chrono::steady_clock::now();
  const cairn::AlignmentResult result = cairn::align_maps(a, b);
  row.took_s.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  ++row.tries;
  if (!result.alignment) return;
  ++row.found;
  const Pose2 error = result.alignment->T_a_b * T_new_old;
  row.errors_m.push_back(std::hypot(error.x_m, error.y_m));
  row.errors_deg.push_back(std::abs(cairn::degrees(error.theta_rad)));
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

void print(const std::string& name, const Row& row, bool is_same_place) {
  std::cout << fmt::format("| {} | {} of {} | ", name, row.found, row.tries);
  if (is_same_place)
    std::cout << fmt::format("{:.3f} | {:.2f}", largest(row.errors_m), largest(row.errors_deg));
  else
    std::cout << "|";
  std::cout << fmt::format(" | {:.2f} |\n", largest(row.took_s)) << std::flush;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Place> places;
  try {
    for (int i = 1; i < argc; ++i)
      if (auto place = place_of(argv[i])) places.push_back(std::move(*place));
  } catch (const std::exception& error) {  // a map that cannot be read
    std::cerr << error.what() << "\n";
    return 2;
  }
  if (places.empty() || static_cast<int>(places.size()) != argc - 1) {
    std::cerr << "merge_table PLACE=MAP,MAP,... ...\n";
    return 2;
  }
  std::cout << "| maps of | aligned | largest error, m | degrees | longest search, s |\n"
               "|---|---:|---:|---:|---:|\n";
  cairn::PortableRandom random(11);
  for (const Place& place : places) {
    Row row;
    for (std::size_t a = 0; a < place.maps.size(); ++a)
      for (std::size_t b = a + 1; b < place.maps.size(); ++b)
        for (int i = 0; i <= kOtherFrames; ++i) {
          const Pose2 T_new_old =
              i == 0 ? Pose2{}
                     : Pose2{random.between(-20.0, 20.0), random.between(-20.0, 20.0), random.between(-3.14, 3.14)};
          align(place.maps[a], i == 0 ? place.maps[b] : in_other_frame(place.maps[b], T_new_old), T_new_old, row);
        }
    print(place.name, row, true);
  }
  Row different;
  for (const Place& a : places)
    for (const Place& b : places)
      if (&a < &b)
        for (const SavedMap& first : a.maps)
          for (const SavedMap& second : b.maps) align(first, second, {}, different);
  print("two places", different, false);
  return 0;
}
