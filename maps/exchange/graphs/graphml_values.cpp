#include "maps/exchange/graphs/graphml_values.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "maps/base/json_text.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/file_ids.hpp"

namespace cairn::exchange {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMaxLevel = 1'000'000.0;
constexpr double kMaxExact = static_cast<double>(kMaxFileId);

}  // namespace

void check_text(const SourceText& source, std::string_view text, std::size_t offset) {
  if (first_not_utf8(text) != std::string_view::npos)
    source.fail(offset, "the text names a character that does not exist (&#...;)");
  if (const std::size_t found = first_unprintable(text, kLineCharacters); found != std::string_view::npos)
    source.fail(offset, "the text " + in_quotes(text) + " holds " + name_of_unprintable(text, found));
}

GraphmlValues::GraphmlValues(const SourceText& source, std::vector<GraphmlValue> values)
    : source_(source), values_(std::move(values)) {
  for (const GraphmlValue& value : values_) check_text(source, value.text, value.offset);
}

std::optional<GraphmlValue> GraphmlValues::take(const Names& names) {
  for (const std::string_view name : names) {
    const auto found = std::ranges::find(values_, name, &GraphmlValue::name);
    if (found == values_.end()) continue;
    const GraphmlValue value = *found;
    values_.erase(found);
    return value;
  }
  return std::nullopt;
}

double GraphmlValues::number(const GraphmlValue& value) const {
  const std::string_view text = trimmed(value.text, kXmlBlanks);
  const auto number = number_from<double>(text);
  if (!number || !std::isfinite(*number))
    source_.fail(value.offset, std::string(value.name) + " " + in_quotes(text) + " is not a finite number");
  return *number;
}

std::optional<double> GraphmlValues::take_number(const Names& names) {
  const std::optional<GraphmlValue> value = take(names);
  return value ? std::optional(number(*value)) : std::nullopt;
}

std::optional<double> GraphmlValues::take_coordinate(const Names& names) {
  const std::optional<GraphmlValue> value = take(names);
  if (!value) return std::nullopt;
  const double coordinate_m = number(*value);
  source_.check_coordinate(value->offset, coordinate_m);
  return coordinate_m;
}

bool GraphmlValues::flag(const GraphmlValue& value) const {
  std::string text(trimmed(value.text, kXmlBlanks));
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (text != "true" && text != "false" && text != "1" && text != "0")
    source_.fail(value.offset, std::string(value.name) + " " + in_quotes(value.text) + " is neither true nor false");
  return text == "true" || text == "1";
}

bool GraphmlValues::take_flag(std::string_view name) {
  const std::optional<GraphmlValue> value = take({name});
  return value && flag(*value);
}

int GraphmlValues::take_level() {
  const std::optional<GraphmlValue> value = take({"level"});
  if (!value) return 0;
  const double level = number(*value);
  if (level != std::floor(level) || std::abs(level) > kMaxLevel)
    source_.fail(value->offset,
                 "level " + number_text(level) + " is not a floor: it must be a whole number of -1000000 to 1000000");
  return static_cast<int>(level);
}

std::string GraphmlValues::take_text(const Names& names) {
  const std::optional<GraphmlValue> value = take(names);
  return value ? std::string(value->text) : "";
}

std::optional<MarkerId> GraphmlValues::take_marker() {
  const std::optional<GraphmlValue> value = take({"april_tag"});
  if (!value) return std::nullopt;
  const std::optional<MarkerName> name = marker_name_in(value->text);
  if (!name)
    source_.fail(value->offset,
                 "april_tag " + in_quotes(value->text) + " is none: it must read as tag 7 or tag 25h9 7");
  return MarkerId{name->family.value_or(MarkerFamily::tag36h11), name->number};
}

std::string GraphmlValues::take_annotations() {
  const std::optional<GraphmlValue> text = take({"annotations"});
  if (text && !is_json_object(text->text)) source_.fail(text->offset, "annotations must be the text of a JSON object");
  if (!text && values_.empty()) return "";
  Json all = text ? Json::parse(text->text) : Json::object();
  for (const GraphmlValue& value : values_) {
    const std::string name(value.name);
    if (value.type == "boolean") {
      all[name] = flag(value);
    } else if (value.type == "double" || value.type == "float") {
      all[name] = number(value);
    } else if (const bool is_whole = value.type == "int" || value.type == "long";
               is_whole && std::abs(number(value)) <= kMaxExact) {
      all[name] = static_cast<std::int64_t>(number(value));
    } else {
      all[name] = std::string(value.text);
    }
  }
  values_.clear();
  return all.dump();
}

}  // namespace cairn::exchange
