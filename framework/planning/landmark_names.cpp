#include "framework/planning/landmark_names.hpp"

#include <fmt/format.h>

#include "framework/planning/place.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

constexpr std::size_t kLongestName = 200;

}  // namespace

std::string refusal_of_name(const std::string& name, const LandmarkGraph& graph, const ClusterTree& clusters,
                            const std::string* own) {
  if (name.empty()) return "it is empty";
  if (name.size() > kLongestName) return fmt::format("it is longer than {} bytes", kLongestName);
  if (exchange::first_not_utf8(name) != std::string::npos) return "it is not UTF-8 text";
  if (first_unprintable(name) != std::string::npos) return "it holds a control character";
  if (name.front() == ' ' || name.back() == ' ') return "it begins or ends with a blank";
  if (looks_like_id(name)) return "it looks like an id";
  if (reads_as_place(name)) return "it reads as a place: x,y or nearest CATEGORY";
  for (const auto& [id, landmark] : graph.landmarks())
    if (&landmark.name != own && landmark.name == name) return fmt::format("landmark L{} has it", id);
  for (const auto& [id, cluster] : clusters.clusters)
    if (&cluster.name != own && cluster.name == name)
      return fmt::format("cluster C{}:L{} has it", cluster.level, cluster.anchor);
  return "";
}

}  // namespace cairn
