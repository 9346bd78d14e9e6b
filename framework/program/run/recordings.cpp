#include "framework/program/run/recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace cairn {
namespace {

constexpr const char* kNoRecording = "none";

// The name, or the first that no earlier run has used: run.mcap, run.2.mcap, ...
std::string unused_name(const std::filesystem::path& folder, const std::string& name, const std::string& other) {
  const std::size_t end = std::min(name.find('.', 1), name.size());
  std::string unused = name;
  for (int i = 2; unused == other || std::filesystem::exists(folder / unused); ++i)
    unused = fmt::format("{}.{}{}", name.substr(0, end), i, name.substr(end));
  return unused;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read for the recording");
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void choose_recordings(MissionConfig& config, const RunCommand& command, bool is_real) {
  if (config.record == kNoRecording)
    config.record.clear();
  else if (config.record.empty() && is_real)
    config.record = unused_name(command.out, config.mission + ".log.gz", config.record_mcap);
  else if (!config.record.empty() && !command.resume.empty())
    config.record = unused_name(command.out, config.record, config.record_mcap);
  if (!config.record_mcap.empty() && !command.resume.empty())
    config.record_mcap = unused_name(command.out, config.record_mcap, config.record);
}

void finish(RunRecording& recording) {
  try {
    recording.close();
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
  }
}

void finish(McapRecording& recording, const RunCommand& command, const MissionResult& result,
            const OccupancyGrid* grid) {
  const auto attach = [&](const std::filesystem::path& file, const char* media_type) {
    if (std::filesystem::is_regular_file(file)) recording.attach(file.filename().string(), media_type, bytes_of(file));
  };
  try {
    attach(command.mission, "application/yaml");
    attach(command.out / "report.json", "application/json");
    if (!result.map_file.empty()) attach(command.out / result.map_file, "application/vnd.sqlite3");
    recording.close(grid);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
  }
}

}  // namespace cairn
