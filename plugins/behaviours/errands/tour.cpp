#include "plugins/behaviours/errands/tour.hpp"

namespace cairn::behaviours {
namespace {

constexpr int kRoundsAReport = 100;

int to_rounds(const ConfigValue& value) {
  const bool is_text = value.kind == ConfigValue::Kind::scalar && value.kind_name() == "text";
  if (is_text && value.scalar == "forever") return 0;
  if (is_text)
    throw ConfigError(value.place, "rounds must be forever or a number, found " + in_quotes(value.scalar) +
                                       did_you_mean(value.scalar, {"forever"}));
  return static_cast<int>(config_detail::to_integer(value, "rounds", {1.0, 1e6}));
}

}  // namespace

void TourConfig::describe(Fields<TourConfig>& fields) {
  using C = TourConfig;
  fields
      .raw("places", &C::places, "list of places",
           "each `[x, y]`, a landmark's id (L3) or name, a category, or `nearest CATEGORY`: the nearest when it is "
           "gone to, with "
           "`shortest` from where the tour begins")
      .required = true;
  describe_visits(fields);
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "when it is up the step has failed");
  fields.shorthand("places");
}

Tour::Tour(const TourConfig& config, std::uint64_t seed)
    : config_(config), seed_(seed), visits_(config, seed, to_place_names(config.places, "places")) {}

void Tour::halt() {
  *this = Tour(config_, seed_);
}

Status Tour::tick(const WorldView& world, BehaviourContext& context) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ >= config_.at_most_s) return {StepState::failure, "time is up: " + visits_.summary()};
  return visits_.tick(world, context);
}

void PatrolConfig::describe(Fields<PatrolConfig>& fields) {
  using C = PatrolConfig;
  fields.raw("rounds", &C::patrol_rounds, "rounds", "how many: a number from 1, or forever").required = true;
  fields.raw(
      "places", &C::places, "list of places",
      "as those of `tour`; without them, all landmarks that are known when a round begins, the first 50 of more");
  fields.number(
      "min_round_s", &C::min_round_s, {0.0, 1e6}, "s",
      "a round that took less is followed by a pause up to this time, as when the robot is at its only place");
  describe_visits(fields);
  fields.shorthand("rounds");
}

Patrol::Patrol(const PatrolConfig& config, std::uint64_t seed)
    : config_(config), seed_(seed), rounds_wanted_(to_rounds(config.patrol_rounds)) {
  if (config.places.kind != ConfigValue::Kind::null) places_ = to_place_names(config.places, "places");
}

void Patrol::halt() {
  *this = Patrol(config_, seed_);
}

std::vector<PlaceName> Patrol::all_landmarks(const LandmarkGraph& graph, BehaviourContext& context) const {
  std::vector<PlaceName> places;
  for (const auto& [id, landmark] : graph.landmarks())
    if (places.size() < kMaxPlaces) places.push_back({"L" + std::to_string(id), std::nullopt});
  const std::size_t all = graph.landmarks().size();
  if (all > places.size())
    context.report("a round has " + std::to_string(kMaxPlaces) +
                   " places at most: " + std::to_string(all - places.size()) + " of " + std::to_string(all) +
                   " landmarks are left out of it");
  return places;
}

Status Patrol::begin_round(const WorldView& world, BehaviourContext& context) {
  const bool chooses_itself = places_.empty();
  std::vector<PlaceName> places = chooses_itself ? all_landmarks(world.graph, context) : places_;
  if (places.empty()) return {StepState::failure, "there is nothing to patrol: the map holds no landmark"};
  round_.emplace(config_, seed_, std::move(places), chooses_itself ? Unknown::left_out : Unknown::as_skip_says);
  const std::string of = rounds_wanted_ == 0 ? "" : " of " + std::to_string(rounds_wanted_);
  round_begun_s_ = world.time_s;
  if (is_reported()) context.report("round " + std::to_string(rounds_done_ + 1) + of + " begins");
  return {StepState::running, "round " + std::to_string(rounds_done_ + 1) + of};
}

// Of rounds that are alike the first two, then one in a hundred, and the last.
bool Patrol::is_reported() const {
  const int round = rounds_done_ + 1;
  return alike_rounds_ < 2 || round % kRoundsAReport == 0 || round == rounds_wanted_;
}

void Patrol::end_round(BehaviourContext& context) {
  visited_ += round_->visited();
  left_out_ += round_->left_out();
  const std::string summary = round_->summary();
  if (is_reported() || summary != last_summary_)
    context.report("round " + std::to_string(rounds_done_ + 1) + " is done: " + summary);
  alike_rounds_ = summary == last_summary_ ? alike_rounds_ + 1 : 1;
  last_summary_ = summary;
  ++rounds_done_;
  round_.reset();
}

Status Patrol::tick(const WorldView& world, BehaviourContext& context) {
  if (!round_) {
    const double next_s = round_begun_s_ ? *round_begun_s_ + config_.min_round_s : world.time_s;
    if (world.time_s < next_s) return {StepState::running, "pausing before the next round", next_s - world.time_s};
    return begin_round(world, context);
  }
  const Status status = round_->tick(world, context);
  const std::string number = "round " + std::to_string(rounds_done_ + 1);
  if (status.state != StepState::success) return {status.state, number + ": " + status.reason, status.left_s};
  end_round(context);
  if (rounds_done_ != rounds_wanted_) return {StepState::running, number + " is done"};
  return {StepState::success, std::to_string(rounds_done_) + (rounds_done_ == 1 ? " round, " : " rounds, ") +
                                  std::to_string(visited_) + " places visited" +
                                  (left_out_ == 0 ? "" : ", " + std::to_string(left_out_) + " left out")};
}

}  // namespace cairn::behaviours
