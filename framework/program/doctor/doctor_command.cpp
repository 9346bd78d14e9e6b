#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/mission/modules.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/making_watch.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/doctor/live_check.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

// As the collision monitor has it; where it measures the period itself, the longest that it takes.
double blind_s_of(const Mission& mission) {
  const double period_s = reading_period_s(mission.robot);
  return mission.config.collision_monitor.blind_s.value_or(period_s > 0.0 ? 1.5 * period_s : 1.0);
}

constexpr std::size_t kMinColumn = 16;
constexpr std::size_t kMaxColumn = 40;

std::string text_of(const std::vector<Finding>& findings) {
  std::size_t column = kMinColumn;
  for (const Finding& finding : findings) column = std::max(column, std::min(finding.what.size(), kMaxColumn));
  std::string text;
  for (const Finding& finding : findings)
    text += fmt::format("{} {:<{}} {}\n", finding.is_good ? "ok " : "BAD", finding.what, column, finding.text);
  return text;
}

ordered_json json_of(const Finding& finding) {
  ordered_json json{{"ok", finding.is_good}, {"what", finding.what}, {"text", finding.text}};
  for (const ConnectionValue& value : finding.values) json["values"][value.name] = value.text;
  return json;
}

// What the sensor is connected to is read next to whether it is.
void add_connection(Sensor& sensor, std::vector<Finding>& findings) {
  auto* const report = dynamic_cast<ConnectionReport*>(&sensor);
  if (report == nullptr) return;
  const std::vector<Finding> parts = findings_of(report->connection_parts());
  findings.insert(std::next(findings.begin()), parts.begin(), parts.end());
}

}  // namespace

int doctor_live(const DoctorLiveCommand& command, const CommonOptions& common) {
  const std::atomic<bool>& end = cancel_on_interrupt();
  const Mission mission = load_mission(command.mission, command.overrides, std::nullopt);
  const ModuleLibrary library = module_library(common);
  const MakingWatch watch = watch_making(max_making_s(mission.config.watchdog_s), end);
  const std::shared_ptr<Sensor> sensor = build_sensor(mission, library);
  LiveCheck check(mission.robot, blind_s_of(mission), mission.config.collision_monitor.stop_after_s);
  check.watch(*sensor, command.for_s, end);
  std::vector<Finding> findings = check.findings(sensor->drive() != nullptr);
  add_connection(*sensor, findings);
  const auto all_good = [&] { return std::ranges::all_of(findings, &Finding::is_good); };
  const bool may_wiggle = all_good();
  if (command.wiggle && may_wiggle)
    for (const Finding& finding : wiggled(*sensor, end)) findings.push_back(finding);
  ordered_json json{{"mission", mission.config.mission}, {"ok", all_good()}, {"findings", ordered_json::array()}};
  for (const Finding& finding : findings) json["findings"].push_back(json_of(finding));
  std::string text = text_of(findings);
  if (command.wiggle && !may_wiggle) text += "no wheel was turned: mend what is BAD first\n";
  print(json, text, common);
  return all_good() ? kExitDone : kExitNotSolved;
}

}  // namespace cairn
