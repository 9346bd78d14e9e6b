#include "framework/planning/clusters_config.hpp"

namespace cairn {

void ClustersConfig::describe(Fields<ClustersConfig>& fields) {
  using C = ClustersConfig;
  fields.integer("from_landmarks", &C::from_landmarks, {2.0, 1e6}, "a map with fewer landmarks has no clusters");
  fields.integer("max_landmarks", &C::max_landmarks, {4.0, 256.0}, "a cluster of the lowest level holds at most");
  fields.integer("growth", &C::growth, {2.0, 64.0}, "a cluster one level up may hold this many times as many");
  fields.number("narrow_below_m", &C::narrow_below_m, {0.0, 100.0}, "m",
                "a route through a narrower passage divides clusters");
  fields.integer("large_from", &C::large_from, {2.0, 1e6},
                 "from so many landmarks on clusters are made for fast searches, whatever the passages");
}

ClusterSizes ClustersConfig::sizes() const {
  return {.leaf = max_landmarks,
          .growth = growth,
          .large_from = static_cast<std::size_t>(large_from),
          .from = static_cast<std::size_t>(from_landmarks),
          .narrow_below_m = narrow_below_m};
}

std::string text_of(const ClustersConfig& config) {
  return "{from_landmarks: " + std::to_string(config.from_landmarks) +
         ", max_landmarks: " + std::to_string(config.max_landmarks) + ", growth: " + std::to_string(config.growth) +
         ", narrow_below_m: " + config_detail::number_text(config.narrow_below_m) +
         ", large_from: " + std::to_string(config.large_from) + "}";
}

ClusterSizes cluster_sizes_of(const std::map<std::string, std::string>& properties) {
  const auto text = properties.find(kClustersProperty);
  if (text == properties.end()) return {};
  const std::string what = "the saved map's clusters";
  return load_config<ClustersConfig>(parse_config_text(text->second, what), what).sizes();
}

}  // namespace cairn
