// Small logs for tests: written to a folder of the test's own, plain or gzip.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "framework/config/config_value.hpp"
#include "plugins/common/logs/scan_log.hpp"

namespace cairn::log_files {

class LogFolder {
 public:
  LogFolder()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("log_" + std::to_string(getpid()) + "_" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->test_suite_name()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~LogFolder() { std::filesystem::remove_all(folder_); }
  LogFolder(const LogFolder&) = delete;
  LogFolder& operator=(const LogFolder&) = delete;

  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  [[nodiscard]] std::string gzip(const std::string& text) const {
    const auto file = folder_ / "packed.gz";
    const gzFile out = gzopen(file.c_str(), "wb");
    gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
    gzclose(out);
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // A message without the folder.
  [[nodiscard]] std::string without_folder(std::string text) const {
    const std::string name = folder_.string() + "/";
    for (std::size_t at; (at = text.find(name)) != std::string::npos;) text.erase(at, name.size());
    return text;
  }

 private:
  std::filesystem::path folder_;
};

// Everything a sensor says until its end, whose sentence goes to `reason`.
inline std::vector<Observation> play(Sensor& sensor, std::string& reason) {
  std::vector<Observation> seen;
  while (true) {
    const SensorStep step = sensor.next({});
    if (step.state != SensorState::observation) {
      EXPECT_EQ(step.state, SensorState::end_of_data);
      reason = step.reason;
      return seen;
    }
    seen.push_back(step.observation);
  }
}

}  // namespace cairn::log_files
