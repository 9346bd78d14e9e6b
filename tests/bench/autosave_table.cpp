// What the autosaves of a long mission write, from maps that a mission has saved.
//   autosave_table FILE HOURS MAP...
// The maps stand for the mission's map at one autosave after the other, every 30 s, there and back again; the driven
// path grows by 5 m each time. One line an hour.

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "framework/landmarks/driven_path.hpp"
#include "maps/store/map_updater.hpp"

namespace cairn {
namespace {

constexpr double kEvery_s = 30.0;
constexpr int kAutosavesInHour = 120;
constexpr double kDriven_m = 5.0;  // from one autosave to the next
constexpr double kStep_m = 0.0515;

double number_in(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key)) return std::stod(line.substr(key.size()));
  return 0.0;
}

// Rounds of a circle of 3 m, none quite like the one before.
void drive_on(DrivenPath& path, double& driven_m) {
  for (const double end_m = driven_m + kDriven_m; driven_m < end_m; driven_m += kStep_m) {
    const double angle_rad = driven_m / 1.5;
    path.record({2.5 + 1.5 * std::cos(angle_rad) + 0.001 * std::sin(7.0 * angle_rad), 2.5 + 1.5 * std::sin(angle_rad),
                 wrap_angle(angle_rad)});
  }
}

void print_row(double hours, const MapUpdater& updater, const DrivenPath& path) {
  std::printf("%6.2f h: %.1f MB by the writer, %.1f MB by write_bytes, memory %.1f MB, file %.0f kB, %zu poses\n",
              hours, static_cast<double>(updater.bytes_written()) / 1e6,
              number_in("/proc/self/io", "write_bytes:") / 1e6, number_in("/proc/self/status", "VmRSS:") / 1024.0,
              static_cast<double>(std::filesystem::file_size(updater.file())) / 1e3, path.poses().size());
  std::fflush(stdout);
}

void run(const std::string& file, int hours, const std::vector<std::string>& files) {
  std::vector<SavedMap> maps;
  for (const std::string& map : files) maps.push_back(load_map(map));
  MapUpdater updater(file);
  DrivenPath path;
  double driven_m = 0.0;
  for (int i = 0; i < hours * kAutosavesInHour; ++i) {
    const std::size_t place = static_cast<std::size_t>(i) % (2 * maps.size());
    SavedMap map = maps[place < maps.size() ? place : 2 * maps.size() - 1 - place];
    drive_on(path, driven_m);
    map.driven_path = path.poses();
    if (map.progress) map.progress->time_s = kEvery_s * i;
    updater.save(map);
    if ((i + 1) % kAutosavesInHour == 0) print_row((i + 1.0) / kAutosavesInHour, updater, path);
  }
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: autosave_table FILE HOURS MAP...\n");
    return 2;
  }
  try {
    cairn::run(argv[1], std::stoi(argv[2]), {argv + 3, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
