// What the host makes of what behaviours ask for.
#pragma once

#include <optional>
#include <string>

#include "framework/mission/loop/map_saving.hpp"
#include "framework/mission/loop/text_files.hpp"

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

  // What was asked for since the last call.
  LeafRequests take() { return std::exchange(asked_, {}); }

  void drive(const Twist& wanted) override;
  PlanResult plan(const PlanRequest& request) override;
  // Without the times that it took: the same mission writes the same bytes.
  Status answer(const PlanQuestion& question, const std::string& file_name) override;
  Status save(const std::string& file_name) override;
  Status write(const OutputText& output) override;
  void say(const std::string& sentence) override;

 private:
  const HostParts host_;
  TextFiles texts_;
  LeafRequests asked_;
};

}  // namespace cairn
