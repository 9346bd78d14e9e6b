#include "framework/behaviour_tree/state.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr int kMaxDepth = 6;  // of the text that text_of() writes
constexpr std::size_t kMaxBytes = 16U << 20U;
constexpr std::array kOutcomes{"running", "success", "failure"};  // in the order of StepState

[[noreturn]] void fail(const std::string& what) {
  throw std::invalid_argument(what);
}

const ordered_json& member(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) fail(std::string("a node has no \"") + key + "\"");
  return *found;
}

std::string text_in(const ordered_json& object, const char* key) {
  const ordered_json& value = member(object, key);
  if (!value.is_string()) fail(std::string("\"") + key + "\" of a node is not text");
  return value.get<std::string>();
}

std::uint64_t count_in(const ordered_json& object, const char* key) {
  const ordered_json& value = member(object, key);
  // Far below what any arithmetic on it could overflow.
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > (1ULL << 53U))
    fail(std::string("\"") + key + "\" of a node is not a count");
  return value.get<std::uint64_t>();
}

Status outcome_of(const ordered_json& value) {
  if (!value.is_object()) fail("an outcome is not an object");
  const std::string name = text_in(value, "outcome");
  for (std::size_t i = 0; i < kOutcomes.size(); ++i)
    if (name == kOutcomes[i]) return {static_cast<StepState>(i), text_in(value, "reason")};
  fail("an outcome is called \"" + name.substr(0, 40) + "\"");
}

NodeState node_of(const ordered_json& value) {
  if (!value.is_object()) fail("a node is not an object");
  NodeState node;
  node.path = text_in(value, "path");
  node.next = count_in(value, "next");
  node.rounds = static_cast<std::int64_t>(count_in(value, "rounds"));
  const ordered_json& begun = member(value, "begun_s");
  if (!begun.is_number()) fail("\"begun_s\" of a node is not a number");
  node.begun_s = begun.get<double>();
  if (!std::isfinite(node.begun_s)) fail("\"begun_s\" of a node is not finite");
  node.failures = text_in(value, "failures");
  const ordered_json& outcomes = member(value, "outcomes");
  if (!outcomes.is_array()) fail("\"outcomes\" of a node are no list");
  for (const ordered_json& outcome : outcomes) node.outcomes.push_back(outcome_of(outcome));
  return node;
}

}  // namespace

std::string text_of(const TreeState& state) {
  ordered_json nodes = ordered_json::array();
  for (const NodeState& node : state.running) {
    ordered_json outcomes = ordered_json::array();
    for (const Status& outcome : node.outcomes)
      outcomes.push_back({{"outcome", kOutcomes[static_cast<std::size_t>(outcome.state)]}, {"reason", outcome.reason}});
    nodes.push_back({{"path", node.path},
                     {"next", node.next},
                     {"rounds", node.rounds},
                     {"begun_s", node.begun_s},
                     {"failures", node.failures},
                     {"outcomes", outcomes}});
  }
  return ordered_json{{"running", nodes}}.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

TreeState tree_state_of(const std::string& text) {
  if (text.size() > kMaxBytes) fail("it is too long");
  const auto is_shallow = [](int depth, ordered_json::parse_event_t, ordered_json&) {
    if (depth > kMaxDepth) fail("it is nested too deeply");
    return true;
  };
  ordered_json root;
  try {
    root = ordered_json::parse(text, is_shallow);
  } catch (const ordered_json::exception& error) {
    fail(std::string("it is not JSON: ") + error.what());
  }
  if (!root.is_object() || !root.contains("running") || !root["running"].is_array())
    fail("it holds no list \"running\"");
  TreeState state;
  for (const ordered_json& node : root["running"]) state.running.push_back(node_of(node));
  return state;
}

}  // namespace cairn
