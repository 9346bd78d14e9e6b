#include "framework/experiments/recognition/places.hpp"

#include <algorithm>

namespace cairn {
std::vector<double> degrees_in_order(const std::vector<CategoryDegree>& found,
                                     const std::vector<std::string>& categories) {
  std::vector<double> degrees;
  for (const std::string& category : categories) {
    const auto of_category = std::ranges::find(found, category, &CategoryDegree::category);
    degrees.push_back(of_category == found.end() ? 0.0 : of_category->degree);
  }
  return degrees;
}

void require_one(const Mission& mission, const std::string& category, const std::string& who,
                 const std::filesystem::path& file) {
  const SourcePlace whole{file.string(), 0, 0};
  if (!mission.world) throw ConfigError(whole, "this experiment needs a mission in a simulated world");
  const auto count = std::ranges::count(mission.world->objects, category, &WorldObject::category);
  if (count != 1)
    throw ConfigError(whole, "the mission's world must have one landmark of the category \"" + category + "\" that " +
                                 who + ", but has " + std::to_string(count));
}

std::vector<PlaceDegrees> degrees_at_places(const ExperimentConfig& config, const World& world,
                                            const std::vector<DegreeSample>& samples,
                                            const std::vector<StepReport>& steps) {
  std::vector<PlaceDegrees> places;
  for (std::size_t i = 0; i < std::min(config.places.size(), steps.size()); ++i) {
    const auto object = std::ranges::find(world.objects, config.places[i].looks_at, &WorldObject::category);
    PlaceDegrees place;
    for (const DegreeSample& sample : samples) {
      const double off_m = (sample.region_centre_m - object->T_map_object.position()).norm();
      if (sample.time_s > steps[i].end_s || off_m > config.looks_within_m) continue;
      place = {degrees_in_order(sample.degrees, config.categories), sample.time_s};
    }
    places.push_back(std::move(place));
  }
  return places;
}

void check_places(const ExperimentConfig& config, const Mission& mission, const std::filesystem::path& file) {
  const SourcePlace whole{file.string(), 0, 0};
  if (mission.steps.size() < config.places.size())
    throw ConfigError(whole, "the mission has " + std::to_string(mission.steps.size()) + " steps, but the experiment " +
                                 std::to_string(config.places.size()) + " places, one at the end of each step");
  for (const PlaceConfig& place : config.places)
    require_one(mission, place.looks_at, "place " + place.name + " looks at", file);
}

}  // namespace cairn
