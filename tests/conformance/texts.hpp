// Answers of modules as text: equal texts are equal answers to the last bit, and a failure shows both.
#pragma once

#include <string>
#include <vector>

#include "framework/contracts/module.hpp"

namespace cairn::conformance {

[[nodiscard]] std::string text_of(double value);
[[nodiscard]] std::string text_of(const Pose2& pose);
[[nodiscard]] std::string text_of(const Twist& twist);
[[nodiscard]] std::string text_of(const SensorStep& step);
[[nodiscard]] std::string text_of(const PoseEstimate& estimate);
[[nodiscard]] std::string text_of(const DetectionReport& report);
[[nodiscard]] std::string text_of(const PlanResult& result);  // without the times
[[nodiscard]] std::string text_of(const PathResult& result);
[[nodiscard]] std::string text_of(const RouteResult& result);
[[nodiscard]] std::string text_of(const Status& status);
[[nodiscard]] std::string text_of(Cell cell);

template <class Answer>
[[nodiscard]] std::string text_of(const std::vector<Answer>& answers) {
  std::string text;
  for (const Answer& answer : answers) text += text_of(answer) + "\n";
  return text;
}

}  // namespace cairn::conformance
