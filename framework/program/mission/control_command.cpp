#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/behaviour_tree/time_left.hpp"
#include "framework/mission/orders/order_text.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/mission/control_socket.hpp"
#include "maps/base/printable.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

// Whatever a file or another program may have written there, in one line.
std::string text_in(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? printable(found->get<std::string>()) : "";
}

double number_in(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
}

std::filesystem::path autosave_in(const std::filesystem::path& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().string().ends_with(".autosave.cairn")) return entry.path();
  return {};
}

std::string cut_short_text(const std::filesystem::path& folder) {
  const std::filesystem::path map = autosave_in(folder);
  return folder.string() + ": the mission here was cut short" +
         (map.empty() ? std::string()
                      : "; cairn run --resume " + printable(map.string()) + " MISSION resumes from what it has saved");
}

std::string where_text(const ordered_json& status) {
  std::string text = fmt::format("{:.1f} s", number_in(status, "time_s"));
  if (number_in(status, "steps") > 0.0 && !text_in(status, "step_name").empty())
    text += fmt::format(", step {:.0f} of {:.0f}: {}", number_in(status, "step"), number_in(status, "steps"),
                        text_in(status, "step_name"));
  if (!text_in(status, "doing").empty()) text += " (" + text_in(status, "doing") + ")";
  return text;
}

std::string left_text(const ordered_json& status) {
  TimeLeft left;
  const auto eta = status.find("eta_s");
  const auto most = status.find("eta_at_most_s");
  if (eta == status.end() || most == status.end()) return "";
  left.about_s = number_in(status, "eta_s");
  if (most->is_number()) left.max_s = most->get<double>();
  if (const auto without = status.find("eta_without"); without != status.end() && without->is_array())
    for (const ordered_json& what : *without)
      if (what.is_string()) left.without.push_back(printable(what.get<std::string>()));
  return text_of(left);
}

void print_status(const ordered_json& status) {
  const std::string state = text_in(status, "state");
  const std::string outcome = text_in(status, "outcome");
  const std::string reason = text_in(status, "reason");
  std::cout << fmt::format("mission {}: {}{}{}\n", text_in(status, "mission"), state,
                           outcome.empty() ? "" : ", " + outcome, reason.empty() ? "" : ": " + reason);
  if (state == "starting") return;
  const ordered_json pose = status.value("pose", ordered_json::object());
  std::cout << "  " << where_text(status) << "\n";
  if (pose.is_object() && !pose.empty())
    std::cout << fmt::format("  at ({:.2f}, {:.2f}), {:.0f} % known, {:.0f} landmarks, {:.1f} m driven\n",
                             number_in(pose, "x_m"), number_in(pose, "y_m"),
                             100.0 * number_in(status, "explored_ratio"), number_in(status, "landmarks"),
                             number_in(status, "distance_m"));
  if (state == "running" || state == "paused") std::cout << "  " << left_text(status) << "\n";
}

// Of a mission that has ended: from its report.
std::optional<ordered_json> ended_status(const std::filesystem::path& folder) {
  std::ifstream in(folder / "report.json", std::ios::binary);
  const ordered_json report = in ? ordered_json::parse(in, nullptr, false) : ordered_json();
  if (!report.is_object() || text_in(report, "outcome").empty()) return std::nullopt;
  const auto landmarks = report.find("landmarks");
  return ordered_json{{"mission", text_in(report, "mission")},
                      {"state", "ended"},
                      {"time_s", number_in(report, "time_s")},
                      {"explored_ratio", number_in(report, "explored_ratio")},
                      {"distance_m", number_in(report, "distance_m")},
                      {"landmarks", landmarks != report.end() ? landmarks->size() : 0},
                      {"outcome", text_in(report, "outcome")},
                      {"reason", text_in(report, "reason")},
                      {"map", text_in(report, "map")}};
}

[[noreturn]] void fail_nobody(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw std::runtime_error(folder.string() + ": there is no such folder");
  throw std::runtime_error(folder.string() + ": no mission runs in this folder");
}

ordered_json status_without_answer(const std::filesystem::path& folder, Reached reached) {
  if (reached == Reached::left_behind) {
    const std::filesystem::path map = autosave_in(folder);
    return {{"state", "cut_short"}, {"map", map.empty() ? "" : map.filename().string()}};
  }
  if (auto ended = ended_status(folder)) return std::move(*ended);
  throw std::runtime_error(folder.string() + ": no mission runs in this folder, and none has ended here");
}

ordered_json parsed(const std::filesystem::path& folder, const std::string& line) {
  ordered_json answer = ordered_json::parse(line, nullptr, false);
  if (!answer.is_object() || !answer.contains("ok"))
    throw std::runtime_error(folder.string() + ": what listens there is no mission");
  if (!answer["ok"].is_boolean() || !answer["ok"].get<bool>())
    throw std::runtime_error(folder.string() + ": " + text_in(answer, "error"));
  return answer;
}

// What has come of the command, and whether it is what was wanted.
std::pair<std::string, bool> reported(const std::string& command, const ordered_json& answer) {
  const std::string mission = "mission " + text_in(answer, "mission");
  const std::string state = text_in(answer, "state");
  const std::string outcome = text_in(answer, "outcome");
  if (state == "ended") {
    const std::string map = text_in(answer, "map");
    const std::string text = mission + " has ended: " + outcome + (map.empty() ? ", no map saved" : ", saved " + map);
    return {text, command == "cancel" && outcome == "cancelled"};
  }
  const std::string wanted = command == "pause" ? "paused" : command == "resume" ? "running" : "ended";
  if (state == wanted)
    return {mission + (command == "pause" ? " is paused at " : " resumed at ") + where_text(answer), true};
  if (state == "starting") return {mission + " is starting; the command takes effect with its first tick", true};
  return {mission + " has received " + command + ", but is still busy at " + where_text(answer), false};
}

// An order as it goes to the mission. Throws ConfigError on one that no mission takes.
std::string line_of(const MissionControlCommand& command) {
  return command.command == "order" ? "order " + parse_order(command.order).text : command.command;
}

std::pair<std::string, bool> order_reported(const ordered_json& answer) {
  const bool is_taken = answer.value("taken", ordered_json(false)) == ordered_json(true);
  const std::string reason = text_in(answer, "reason");
  if (!is_taken) return {"not taken: " + reason, false};
  return {
      fmt::format("taken at {:.1f} s, tick {:.0f}: {}", number_in(answer, "time_s"), number_in(answer, "tick"), reason),
      true};
}

}  // namespace

int mission_control(const MissionControlCommand& command, const CommonOptions& common) {
  const std::string line = line_of(command);
  if (!std::filesystem::is_directory(command.out)) fail_nobody(command.out);
  const ControlAnswer reached = ask_mission(command.out, line);
  if (reached.reached == Reached::left_behind) throw std::runtime_error(cut_short_text(command.out));
  if (reached.reached == Reached::nobody) fail_nobody(command.out);
  const ordered_json answer = parsed(command.out, reached.line);
  const auto [text, is_done] = command.command == "order" ? order_reported(answer) : reported(command.command, answer);
  print_report(answer, text, {}, common);
  return is_done ? kExitDone : kExitNotSolved;
}

int mission_status(const MissionControlCommand& command, const CommonOptions& common) {
  if (!std::filesystem::is_directory(command.out)) fail_nobody(command.out);
  const ControlAnswer reached = ask_mission(command.out, "status");
  const ordered_json status = reached.reached == Reached::answered
                                  ? parsed(command.out, reached.line)
                                  : status_without_answer(command.out, reached.reached);
  if (common.json)
    print_json(status);
  else if (text_in(status, "state") == "cut_short")
    std::cout << cut_short_text(command.out) << "\n";
  else
    print_status(status);
  return kExitDone;
}

}  // namespace cairn
