#include "framework/program/view/edit_api.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/config/fields.hpp"
#include "framework/files/template_file.hpp"
#include "framework/program/map/map_edits.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kChangeBody = "the request";

struct Naming {
  std::string what;
  std::string name;
  static void describe(Fields<Naming>& fields) {
    fields.text("what", &Naming::what, "id or name of a landmark or a cluster").required = true;
    fields.text("name", &Naming::name, "its new name; empty: none").required = true;
  }
};

struct Closing {
  std::string route;
  bool both_ways = false;
  static void describe(Fields<Closing>& fields) {
    fields.text("route", &Closing::route, "its number, as R12").required = true;
    fields.flag("both_ways", &Closing::both_ways, "those that lead back too");
  }
};

struct Capturing {
  std::string at;
  std::string category;
  double radius_m = CaptureCommand{}.radius_m;
  static void describe(Fields<Capturing>& fields) {
    fields.text("at", &Capturing::at, "a place of the map").required = true;
    fields.text("category", &Capturing::category, "of the template").required = true;
    fields.number("radius_m", &Capturing::radius_m, {0.05, 20.0}, "m", "how far from the place it may reach");
  }
};

template <class Body>
Body body_as(const std::string& text, const std::string& change) {
  if (!Json::accept(text)) throw ConfigError({kChangeBody, 1, 1}, "the body of a change is one JSON object");
  return load_config<Body>(parse_config_text(text, kChangeBody), change);
}

Json renamed(const fs::path& map, const Naming& naming) {
  return {{"id", name_in_map(map, naming.what, naming.name)}, {"name", naming.name}};
}

Json closed(const fs::path& map, const Closing& closing, bool is_closed) {
  CloseCommand command;
  command.map = map;
  command.routes = {closing.route};
  command.both_ways = closing.both_ways;
  return {{"changed", set_closed_in_map(command, is_closed)}, {"closed", is_closed}};
}

Json captured(const fs::path& map, const Capturing& capturing) {
  check_category(capturing.category, {kChangeBody, 1, 1});
  CaptureCommand command;
  command.map = map;
  command.at = capturing.at;
  command.category = capturing.category;
  command.radius_m = capturing.radius_m;
  command.out = map.parent_path() / (capturing.category + ".yaml");
  const CapturedTemplate made = capture_template(command);
  return {{"file", command.out.string()},
          {"category", made.shape.category},
          {"diameter_m", made.shape.contour.outer_diameter_m()}};
}

}  // namespace

ViewResponse edit_map(const fs::path& map, const std::string& change, const std::string& body) {
  try {
    Json answer;
    if (change == "name")
      answer = renamed(map, body_as<Naming>(body, change));
    else if (change == "close" || change == "open")
      answer = closed(map, body_as<Closing>(body, change), change == "close");
    else if (change == "capture")
      answer = captured(map, body_as<Capturing>(body, change));
    else
      return view_error(404, "there is nothing of that name");
    return {200, "application/json", answer.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"};
  } catch (const std::runtime_error& error) {
    return view_error(400, error.what());
  }
}

}  // namespace cairn
