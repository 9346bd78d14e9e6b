#include "plugins/behaviours/errands/records.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "framework/files/template_file.hpp"
#include "maps/landmarks/captured_outline.hpp"
#include "plugins/behaviours/errands/file_name.hpp"

namespace cairn::behaviours {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

const std::vector<std::string> kNames{"area",      "battery", "distance", "explored",
                                      "landmarks", "nearest", "place",    "time"};

double known_area_m2(const OccupancyGrid& grid) {
  const CellBox all = grid.bounds();
  std::int64_t known = 0;
  for (int y = all.min.y; y < all.max.y; ++y)
    for (int x = all.min.x; x < all.max.x; ++x)
      if (grid.state({x, y}) != CellState::unknown) ++known;
  return static_cast<double>(known) * grid.cell_m() * grid.cell_m();
}

std::string value_of(const std::string& name, const WorldView& world) {
  const Point here = world.pose.T_map_robot.position();
  const Landmark* const nearest = world.graph.nearest(here, 1e9);
  if (name == "time") return number("%.0f s", world.time_s);
  if (name == "place") return described(here);
  if (name == "explored") return number("%.1f %%", 100.0 * known_ratio(world.grid));
  if (name == "area") return number("%.1f m2", known_area_m2(world.grid));
  if (name == "landmarks") return std::to_string(world.graph.landmarks().size());
  if (name == "nearest") return nearest == nullptr ? "no landmark" : described(*nearest);
  if (name == "distance")
    return nearest == nullptr ? "unknown" : number("%.2f m", (nearest->T_map_landmark.position() - here).norm());
  const bool knows = world.observation != nullptr && world.observation->battery_ratio;
  return knows ? number("%.0f %%", 100.0 * *world.observation->battery_ratio) : "unknown";
}

std::vector<std::string> texts_of(const ConfigValue& list, const std::string& key) {
  std::vector<std::string> texts;
  if (list.kind == ConfigValue::Kind::null) return texts;
  for (const ConfigValue& item : config_detail::to_list(list, key)) texts.push_back(config_detail::to_text(item, key));
  return texts;
}

}  // namespace

void CaptureTemplateConfig::describe(Fields<CaptureTemplateConfig>& fields) {
  using C = CaptureTemplateConfig;
  fields.raw("at", &C::at, "place", "`[x, y]`, a landmark's id (L3) or name, a category, or `nearest CATEGORY`")
      .required = true;
  fields.raw("name", &C::name, "text", "the category of the template").required = true;
  fields.raw("file", &C::file, "text", "its name in the output folder; without it, the category and .yaml");
  fields.number("radius_m", &C::radius_m, {0.05, 10.0}, "m", "what lies wholly within this of the place");
}

CaptureTemplate::CaptureTemplate(const CaptureTemplateConfig& config)
    : at_(to_place_name(config.at, "at")),
      category_(config_detail::to_file_name(config.name, "name")),
      file_name_(file_name_of(config.file, category_ + ".yaml", ".yaml")),
      radius_m_(config.radius_m) {
  check_category(category_, config.name.place);
}

Status CaptureTemplate::tick(const WorldView& world, BehaviourContext& context) {
  const FoundPlace found = find_place(at_, world);
  if (!found.unknown.empty()) return {StepState::failure, found.unknown};
  Point at;
  if (found.place.pose)
    at = found.place.pose->position();
  else
    at = world.graph.find(cheapest_of(found.place.landmarks, world, context))->T_map_landmark.position();
  try {
    const CapturedOutline captured = captured_outline(world.grid, at, radius_m_);
    const std::string text = template_text(category_, captured, "a mission's map");
    (void)parse_landmark_shape(text, file_name_);
    Status written = context.write({file_name_, text});
    if (written.state != StepState::success) return written;
    return {StepState::success,
            written.reason + ": " + category_ + ", " + number("%.2f m across", captured.contour.outer_diameter_m())};
  } catch (const std::exception& nothing_there) {  // or nothing that a template file can hold
    return {StepState::failure, std::string("no template of ") + category_ + ": " + nothing_there.what()};
  }
}

void PlanQueryConfig::describe(Fields<PlanQueryConfig>& fields) {
  using C = PlanQueryConfig;
  fields.raw("from", &C::from, "text", "`here`, or a place as `cairn plan` takes it: x,y, a landmark's id or name, ...")
      .default_text = "here";
  fields.raw("to", &C::to, "text", "the same").required = true;
  fields.raw("via", &C::via, "list of texts", "places to pass, in this order");
  fields.texts("avoid", &C::avoid, "landmarks and clusters that are not passed");
  fields.texts("closed", &C::closed, "routes that are not taken: 12 or R12");
  fields.integer("alternatives", &C::alternatives, {0.0, 1000.0}, "so many more routes; not with via");
  fields.choice("cost", &C::cost,
                {{"length", C::Cost::length}, {"time", C::Cost::time}, {"clearance", C::Cost::clearance}},
                "what a good route has little (length, time) or much of");
  fields.flag("explain", &C::explain, "how the answer came about");
  fields.raw("file", &C::file, "text", "its name in the output folder, NAME.jsonl").default_text = "answers.jsonl";
  fields.shorthand("to");
}

PlanQuery::PlanQuery(const PlanQueryConfig& config)
    : question_{config.from.kind == ConfigValue::Kind::null ? "here" : config_detail::to_text(config.from, "from"),
                config_detail::to_text(config.to, "to"),
                texts_of(config.via, "via"),
                config.avoid,
                config.closed,
                config.alternatives},
      file_name_(file_name_of(config.file, "answers.jsonl", ".jsonl")) {
  question_.cost = config.cost == PlanQueryConfig::Cost::time        ? "time"
                   : config.cost == PlanQueryConfig::Cost::clearance ? "clearance"
                                                                     : "length";
  question_.explain = config.explain;
  if (question_.from.empty() || question_.to.empty())
    throw ConfigError(config.to.place, "plan_query: from and to must be places, found an empty text");
  if (!question_.via.empty() && config.alternatives > 0)
    throw ConfigError(config.to.place, "plan_query: alternatives are known from place to place, not for a tour");
}

Status PlanQuery::tick(const WorldView&, BehaviourContext& context) {
  const Status status = context.answer(question_, file_name_);
  return {status.state, question_.from + " -> " + question_.to + ": " + status.reason};
}

void LogConfig::describe(Fields<LogConfig>& fields) {
  fields
      .raw("text", &LogConfig::text, "text",
           "what to say; {place}, {time}, {explored}, {area} (known), {battery}, {landmarks}, {nearest} (landmark) and "
           "{distance} (to "
           "it) stand for what they are then; {{ and }} are braces")
      .required = true;
  fields.shorthand("text");
}

Log::Log(const LogConfig& config) {
  const std::string text = config_detail::to_text(config.text, "text");
  const SourcePlace& place = config.text.place;
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_brace = c == '{' || c == '}';
    if (!is_brace || (i + 1 < text.size() && text[i + 1] == c)) {
      plain += c;
      if (is_brace) ++i;
      continue;
    }
    const std::size_t end = text.find('}', i);
    if (c == '}' || end == std::string::npos)
      throw ConfigError(place, std::string("text: a ") + c + " without its other brace; write " + c + c + " for one");
    const std::string name = text.substr(i + 1, end - i - 1);
    if (std::ranges::find(kNames, name) == kNames.end())
      throw ConfigError(
          place, "text: there is no {" + name + "}" + did_you_mean(name, kNames) +
                     "; there are {area}, {battery}, {distance}, {explored}, {landmarks}, {nearest}, {place} and "
                     "{time}");
    segments_.push_back({plain, false});
    segments_.push_back({name, true});
    plain.clear();
    i = end;
  }
  segments_.push_back({plain, false});
}

Status Log::tick(const WorldView& world, BehaviourContext& context) {
  std::string line;
  for (const Piece& piece : segments_) line += piece.is_name ? value_of(piece.text, world) : piece.text;
  context.report(line);
  return {StepState::success, line.empty() ? "said nothing" : line};
}

}  // namespace cairn::behaviours
