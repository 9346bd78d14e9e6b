// What the host makes of what behaviours ask for.
#pragma once

#include <optional>
#include <string>

#include "framework/landmarks/tracker.hpp"
#include "framework/mission/loop/map_saving.hpp"
#include "framework/mission/loop/staged_modules.hpp"
#include "framework/mission/loop/text_files.hpp"
#include "framework/mission/named_values.hpp"
#include "framework/mission/orders/orders.hpp"

namespace cairn {

// The parts of the host that steps need. All must outlive the steps.
struct HostParts {
  const Mission& mission;
  StageClock& clock;
  const WorldState& world;
  Publisher& publisher;
  CollisionMonitor& monitor;
  Planning& planning;
  MapSaving& saving;
  const Staged<Controller>& controller;  // may be none
  LandmarkTracker& tracker;
  Orders& orders;
};

// What one behaviour has asked for in one tick.
struct LeafRequests {
  std::optional<Twist> wanted{};  // velocity
  bool has_failed_to_save = false;
};

// Each request is the host's work again: it cannot be given up half-way.
class BehaviourRequests final : public BehaviourContext {
 public:
  BehaviourRequests(const HostParts& host, TextFiles texts) : host_(host), texts_(std::move(texts)) {}

  // Whose requests come next. The controller forgets what another leaf has asked it.
  void begin(const TreeNode& leaf);
  // What was asked for since begin().
  LeafRequests take() { return std::exchange(asked_, {}); }
  [[nodiscard]] const NamedValues& values() const { return values_; }
  void restore(NamedValues values) { values_ = std::move(values); }
  // The map has been drawn anew.
  void move_places(const MapMove& move);

  void drive(const Twist& wanted) override;
  ControlResult control(const ControlRequest& request) override;
  PlanResult plan(const PlanRequest& request) override;
  // Without the times that it took: the same mission writes the same bytes.
  Status answer(const PlanQuestion& question, const std::string& file_name) override;
  Status save(const std::string& file_name) override;
  Status write(const OutputText& output) override;
  void report(const std::string& sentence) override;
  std::optional<Place> input(const std::string& name) override;
  void output(const std::string& name, const Place& place) override;
  Status name_landmark(LandmarkId id, const std::string& name) override;
  Status name_cluster(const std::string& cluster, const std::string& name) override;
  std::optional<Order> next_order() override;
  void answer_order(const Status& answer) override;

 private:
  const HostParts host_;
  TextFiles texts_;
  LeafRequests asked_;
  NamedValues values_;                    // that behaviours hand over
  const TreeNode* asking_ = nullptr;      // the leaf that is ticked
  const TreeNode* controlled_ = nullptr;  // the leaf that used the controller last
};

}  // namespace cairn
