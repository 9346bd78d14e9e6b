// Files and folders that mean harm, for tests of the whole program.
#pragma once

#include <gtest/gtest.h>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {

class HostileFiles : public testing::Test {
 protected:
  explicit HostileFiles(const std::string& folder) : folder_(fresh_folder(folder)) {}
  ~HostileFiles() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] static std::string config(const std::string& path) { return source_folder() + "/config/" + path; }
  std::string written(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
    return file(name);
  }
  // A mission in an empty room; sensor: its settings.
  [[nodiscard]] std::string mission(const std::string& name, const std::string& steps, const std::string& more = "",
                                    const std::string& sensor = "{plugin: simulated_robot}") const {
    static_cast<void>(written("world.yaml",
                              "bounds_m: [[0, 0], [3, 3]]\n"
                              "walls: [{points_m: [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0]]}]\n"));
    const bool is_simulated = sensor.find("simulated_robot") != std::string::npos;
    return written(name, "mission: held\nrobot: " + config("robots/pioneer1.yaml") +
                             (is_simulated ? "\nworld: world.yaml" : "") +
                             "\nstart: {at_m: [0.6, 0.6], angle_deg: 0}\nsensor: " + sensor +
                             "\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel, cell_m: 0.05}\n" + more +
                             "steps: " + steps + "\n");
  }

  const std::filesystem::path folder_;
};

}  // namespace cairn::testing_program
