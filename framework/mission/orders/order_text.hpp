// Orders as JSON texts, and files of recorded orders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/contracts/order.hpp"

namespace cairn {

inline constexpr const char* kOrdersFile = "orders.jsonl";  // in the output folder of a run

// One order, `{"goto": "pillar"}`. Settings are checked by the step that takes them. Throws ConfigError, with the
// nearest known kind; about stands for the file in its place.
[[nodiscard]] Order parse_order(const std::string& text, const std::string& about = "order");

struct RecordedOrder {
  std::int64_t tick = 0;  // of the run, from 1; ticks in which the mission was paused do not count
  Order order;
};

// One line of such a file. time_s is for people.
[[nodiscard]] std::string recorded_line(const Order& order, std::int64_t tick, double time_s);
// All lines of a file, in the order of ticks. Throws ConfigError with file:line:column, std::runtime_error when the
// file cannot be read.
[[nodiscard]] std::vector<RecordedOrder> read_orders(const std::filesystem::path& file);

}  // namespace cairn
