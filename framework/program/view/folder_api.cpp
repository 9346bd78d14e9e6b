#include "framework/program/view/folder_api.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/config/config_value.hpp"
#include "framework/mission/orders/order_text.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/mission/control_socket.hpp"
#include "framework/program/view/edit_api.hpp"
#include "framework/program/view/folder_map.hpp"
#include "framework/program/view/page_files.hpp"
#include "framework/program/view/shell_word.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array kCommands{"pause", "resume", "cancel", "order"};

std::optional<std::string> bytes_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(in), {}};
}

bool is_running_in(const fs::path& folder) {
  try {
    return connect_to_mission(folder).reached == Reached::answered;
  } catch (const std::exception&) {
    return false;
  }
}

fs::path map_file(const ViewCommand& command) {
  return fs::is_directory(command.map) ? map_in(command.map) : command.map;
}

// A mission writes its map beside the name it is known by, whoever looks at the file alone.
bool is_written(const fs::path& map) {
  std::error_code error;
  const fs::path file = fs::canonical(map, error);
  const fs::path folder = error ? fs::absolute(map).parent_path() : file.parent_path();
  return is_folder_held(folder) || is_running_in(folder);
}

MapPlannerOptions plan_on(const fs::path& map, const ViewCommand& command) {
  MapPlannerOptions plan;
  plan.map = map;
  plan.planner = command.planner;
  plan.budget_ms = command.budget_ms;
  return plan;
}

}  // namespace

FolderApi::FolderApi(const ViewCommand& command, const CommonOptions& common)
    : command_(command), common_(common), is_folder_(fs::is_directory(command.map)) {
  if (kind() == "map") (void)map();
}

std::string FolderApi::kind() const {
  if (!is_folder_) return "map";
  if (is_running_in(command_.map)) return "live";
  return fs::is_regular_file(command_.map / "report.json") ? "run" : "map";
}

std::shared_ptr<MapApi> FolderApi::map() {
  const std::scoped_lock lock(mutex_);
  if (!map_) map_ = std::make_shared<MapApi>(plan_on(map_file(command_), command_), common_);
  return map_;
}

ViewResponse FolderApi::answer(const ViewRequest& request) {
  if (const auto file = page_file(request.target)) return *file;
  if (request.target == "/api/view") {
    const Json json{{"kind", kind()},
                    {"control", command_.control},
                    {"edit", command_.edit},
                    {"name", command_.map.filename().string()},
                    {"command", "cairn view " + shell_word(command_.map.string())}};
    return {200, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"};
  }
  if (request.target.starts_with(kSteerTarget)) return steer(request);
  if (request.target.starts_with(kEditTarget)) return edit(request);
  if (request.target == "/api/report") return file("report.json");
  if (request.target == "/api/track") return file("track.json");
  if (request.target == "/api/timing") return file("timing.json");
  const bool is_live = kind() == "live";
  if (is_live && request.target == "/api/plan")
    return view_error(409, "the mission is under way; its map can be planned on when it has ended");
  if (!is_live)
    if (auto answered = map()->answer(request)) return std::move(*answered);
  return view_error(404, "there is nothing of that name");
}

ViewResponse FolderApi::file(const std::string& name) const {
  auto text = is_folder_ ? bytes_of_file(command_.map / name) : std::nullopt;
  if (!text) return view_error(404, "the folder holds no " + name);
  return {200, "application/json", std::move(*text)};
}

// The next question is answered from the file as it then is.
ViewResponse FolderApi::edit(const ViewRequest& request) {
  if (!command_.edit) return view_error(403, "this view changes no map: cairn view --edit does");
  const auto refused = [] {
    return view_error(409, "a mission still writes the map; it can be changed when the run has ended");
  };
  if (kind() == "live") return refused();
  const std::scoped_lock lock(mutex_);
  const fs::path map = map_file(command_);
  if (is_written(map)) return refused();
  ViewResponse answer = edit_map(map, request.target.substr(std::string_view(kEditTarget).size()), request.body);
  if (answer.status == 200) map_.reset();
  return answer;
}

ViewResponse FolderApi::steer(const ViewRequest& request) const {
  if (!command_.control) return view_error(403, "this view only watches: cairn view --control steers");
  const std::string name = request.target.substr(std::string_view(kSteerTarget).size());
  if (std::ranges::find(kCommands, name) == kCommands.end()) return view_error(404, "there is nothing of that name");
  if (!is_folder_) return view_error(409, "no mission runs there");
  try {
    const std::string line = name == "order" ? "order " + parse_order(request.body, "the request").text : name;
    if (line.size() > kMaxCommandBytes) return view_error(400, "the order is too long");
    const ControlAnswer answer = ask_mission(command_.map, line);
    if (answer.reached != Reached::answered) return view_error(409, "no mission runs there");
    return {200, "application/json", answer.line + "\n"};
  } catch (const ConfigError& error) {
    return view_error(400, error.what());
  }
}

}  // namespace cairn
