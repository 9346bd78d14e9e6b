#include "framework/mission/orders/order_text.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/config/config_errors.hpp"
#include "framework/config/fields.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMaxLineBytes = 1U << 16U;
constexpr double kMaxTick = 9e15;

struct OrderLine {
  std::int64_t tick = 0;
  double time_s = 0.0;
  ConfigValue order;
  static void describe(Fields<OrderLine>& fields) {
    fields.integer("tick", &OrderLine::tick, {1.0, kMaxTick}, "tick of the run, from 1").required = true;
    fields.number("time_s", &OrderLine::time_s, {}, "s", "the mission's clock, for people");
    fields.raw("order", &OrderLine::order, "map", "the order").required = true;
  }
};

std::vector<std::string> known_kinds() {
  return {kOrderKinds.begin(), kOrderKinds.end()};
}

// Strict JSON, and not only what YAML makes of it.
ordered_json json_of(const std::string& text, const std::string& about) {
  try {
    return ordered_json::parse(text);
  } catch (const ordered_json::parse_error& error) {
    const SourcePlace place{about, 1, static_cast<int>(std::max<std::size_t>(error.byte, 1))};
    throw ConfigError(place, R"(an order is JSON in one line, such as {"goto": "pillar"}; this is none)");
  }
}

Order order_of(const ConfigValue& value, std::string text) {
  const std::vector<std::string> known = known_kinds();
  if (value.kind != ConfigValue::Kind::map || value.entries.size() != 1)
    throw ConfigError(value.place, "an order is a map with one key, one of " + joined(known) + "; found " +
                                       (value.kind == ConfigValue::Kind::map ? counted(value.entries.size(), "key")
                                                                             : value.kind_name()));
  const ConfigValue::Entry& entry = value.entries.front();
  if (std::ranges::find(known, entry.key) == known.end())
    throw ConfigError(entry.key_place, "unknown order " + in_quotes(entry.key) + did_you_mean(entry.key, known) +
                                           "; known are: " + joined(known));
  Order order{entry.key, entry.value, std::move(text)};
  if (order.settings.kind == ConfigValue::Kind::null) order.settings.kind = ConfigValue::Kind::map;
  const bool has_settings = order.settings.kind != ConfigValue::Kind::map || !order.settings.entries.empty();
  if (has_settings && (order.kind == "stop" || order.kind == "finish"))
    throw ConfigError(order.settings.place, order.kind + " takes no settings; write {\"" + order.kind + "\": null}");
  return order;
}

void move_down(ConfigValue& value, int lines) {
  value.place.line += lines;
  for (ConfigValue& item : value.items) move_down(item, lines);
  for (ConfigValue::Entry& entry : value.entries) {
    entry.key_place.line += lines;
    move_down(entry.value, lines);
  }
}

RecordedOrder recorded_order(const std::string& text, const std::string& file, std::int64_t earliest) {
  const ConfigValue value = parse_config_text(text, file);
  const ordered_json json = json_of(text, file);
  const auto line = load_config<OrderLine>(value, "a recorded order");
  if (line.tick < earliest)
    throw ConfigError(value.find("tick")->place, "tick must not be before that of the line above (" +
                                                     std::to_string(earliest) + "), found " +
                                                     std::to_string(line.tick));
  return {line.tick, order_of(line.order, json["order"].dump())};
}

}  // namespace

Order parse_order(const std::string& text, const std::string& about) {
  const ConfigValue value = parse_config_text(text, about);
  return order_of(value, json_of(text, about).dump());
}

std::string recorded_line(const Order& order, std::int64_t tick, double time_s) {
  const ordered_json line{
      {"tick", tick}, {"time_s", std::round(time_s * 1e3) / 1e3}, {"order", ordered_json::parse(order.text)}};
  return line.dump() + "\n";
}

std::vector<RecordedOrder> read_orders(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read: " + std::strerror(errno));
  std::vector<RecordedOrder> orders;
  std::string text;
  for (int above = 0; std::getline(in, text); ++above) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (text.size() > kMaxLineBytes)
      throw ConfigError({file.string(), above + 1, 1}, "a line holds at most 65536 bytes");
    try {
      orders.push_back(recorded_order(text, file.string(), orders.empty() ? 1 : orders.back().tick));
    } catch (const ConfigError& error) {
      throw each_changed(error, [&](const ConfigError& one) -> ConfigError {
        return {{one.place().file, one.place().line + above, one.place().column}, one.sentence()};
      });
    }
    move_down(orders.back().order.settings, above);
  }
  if (in.bad()) throw std::runtime_error(file.string() + ": cannot be read");
  return orders;
}

}  // namespace cairn
