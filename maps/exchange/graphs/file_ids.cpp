#include "maps/exchange/graphs/file_ids.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn::exchange {

NodeIds::NodeIds(std::vector<FileId> nodes, const SourceText& source) {
  std::ranges::sort(nodes,
                    [](const FileId& a, const FileId& b) { return a.id != b.id ? a.id < b.id : a.offset < b.offset; });
  const FileId* second = nullptr;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (nodes[i].id == nodes[i - 1].id && (second == nullptr || nodes[i].offset < second->offset)) second = &nodes[i];
  if (second != nullptr)
    source.fail(second->offset, "node " + std::to_string(second->id) + " is there already, in line " +
                                    std::to_string(source.line_of((second - 1)->offset)));
  sorted_.reserve(nodes.size());
  for (const FileId& node : nodes) sorted_.push_back(node.id);
  if (sorted_.empty() || sorted_.front() != 0) return;
  zero_ = sorted_.back() + 1;
  if (zero_ > kMaxFileId) source.fail(nodes.front().offset, "there is no id left for node 0");
}

LandmarkId NodeIds::landmark_of(std::int64_t id) const {
  if (id == 0) return zero_;
  return std::ranges::binary_search(sorted_, id) ? id : 0;
}

void NodeIds::warn_of_zero(std::vector<std::string>& warnings, const std::string& more) const {
  if (zero_ != 0)
    warnings.push_back("node 0 is landmark L" + std::to_string(zero_) + ": ids of landmarks begin at 1" + more);
}

EdgeIds::EdgeIds(const std::vector<std::int64_t>& ids) {
  std::unordered_set<std::int64_t> taken;
  std::int64_t next = 1;
  routes_.reserve(ids.size());
  for (const std::int64_t id : ids) {
    const bool keeps = id > 0 && taken.insert(id).second;
    routes_.push_back(keeps ? id : 0);
    if (keeps) next = std::max(next, id + 1);
  }
  // Ids beyond the largest, or the free ones below it when the largest is the last possible one.
  for (RouteId& route : routes_) {
    if (route != 0) continue;
    if (next > kMaxFileId) next = 1;
    while (!taken.insert(next).second) ++next;
    route = next++;
    ++renumbered_;
  }
}

std::optional<std::vector<std::int64_t>> numbers_of(const std::vector<std::string_view>& ids) {
  std::vector<std::int64_t> numbers;
  std::string_view letters;
  for (const std::string_view id : ids) {
    const std::size_t first = std::min(id.find_first_of("0123456789"), id.size());
    if (numbers.empty()) letters = id.substr(0, first);
    const std::string_view digits = id.substr(first);
    const auto number = number_from<std::int64_t>(digits);
    const bool is_plain = !digits.empty() && (digits.size() == 1 || digits.front() != '0');
    if (!number || !is_plain || *number > kMaxFileId || id.substr(0, first) != letters) return std::nullopt;
    numbers.push_back(*number);
  }
  const bool are_letters =
      std::ranges::all_of(letters, [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; });
  return are_letters ? std::optional(numbers) : std::nullopt;
}

void warn_of_shared_names(const LandmarkGraph& graph, std::vector<std::string>& warnings) {
  std::unordered_map<std::string_view, int> count;
  std::size_t shared = 0;
  const std::string* first = nullptr;
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (landmark.name.empty() || ++count[landmark.name] != 2) continue;
    ++shared;
    if (first == nullptr) first = &landmark.name;
  }
  if (first == nullptr) return;
  warnings.push_back((shared == 1 ? "1 name belongs" : std::to_string(shared) + " names belong") +
                     " to more than one landmark, the first is " + in_quotes(*first) +
                     ": a name finds the landmark with the lowest id");
}

}  // namespace cairn::exchange
