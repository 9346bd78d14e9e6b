// Tour: visits places once. Patrol: visits them again and again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "plugins/behaviours/errands/visits.hpp"

namespace cairn::behaviours {

struct TourConfig : VisitSettings {
  double at_most_s = 3600.0;
  static void describe(Fields<TourConfig>& fields);
};

class Tour : public Behaviour {
 public:
  // Throws ConfigError on places that are none.
  Tour(const TourConfig& config, std::uint64_t seed);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;

 private:
  TourConfig config_;
  std::uint64_t seed_;
  Visits visits_;
  std::optional<double> begun_s_;
};

struct PatrolConfig : VisitSettings {
  ConfigValue patrol_rounds;  // a number, or `forever`
  double min_round_s = 20.0;
  static void describe(Fields<PatrolConfig>& fields);
};

class Patrol : public Behaviour {
 public:
  // Throws ConfigError on places or rounds that are none.
  Patrol(const PatrolConfig& config, std::uint64_t seed);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;

 private:
  Status begin_round(const WorldView& world, BehaviourContext& context);
  void end_round(BehaviourContext& context);
  [[nodiscard]] bool is_reported() const;  // the round under way
  [[nodiscard]] std::vector<PlaceName> all_landmarks(const LandmarkGraph& graph, BehaviourContext& context) const;

  PatrolConfig config_;
  std::uint64_t seed_;
  std::vector<PlaceName> places_;  // empty: all landmarks
  int rounds_wanted_ = 0;          // 0: for ever
  int rounds_done_ = 0;
  std::size_t visited_ = 0;
  std::size_t left_out_ = 0;
  std::optional<Visits> round_;
  std::optional<double> round_begun_s_;
  std::string last_summary_;
  int alike_rounds_ = 0;  // in a row, by their summaries
};

}  // namespace cairn::behaviours
