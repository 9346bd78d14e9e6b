// Modules of Python files that tests write.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "framework/contracts/behaviour.hpp"
#include "framework/contracts/detector.hpp"
#include "framework/contracts/sensor.hpp"

namespace cairn::testing_python {

// The file's path; each text has one of its own.
[[nodiscard]] std::filesystem::path python_file(const std::string& text);

// What a mission would make of `{file: ..., class: It, settings: ...}`; settings as YAML, empty for none. The robot has
// three sonars of 0.1 to 5 m.
[[nodiscard]] std::shared_ptr<Detector> detector_of(const std::string& text, const std::string& settings = "");
[[nodiscard]] std::shared_ptr<Behaviour> behaviour_of(const std::string& text, const std::string& settings = "");
[[nodiscard]] std::shared_ptr<Sensor> sensor_of(const std::string& text, const std::string& settings = "");

// The same of other settings: `file`, `class` and what they need, as lines of the file "mission.yaml".
[[nodiscard]] std::shared_ptr<Detector> detector_with(const std::string& config);

// The text of what a call throws; empty: nothing.
template <class Call>
[[nodiscard]] std::string error_of(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace cairn::testing_python
