// States of a solution that a search begins with; they live as long as this.
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <utility>
#include <vector>

namespace cairn {

class KnownStates {
 public:
  explicit KnownStates(ompl::base::SpaceInformationPtr info) : info_(std::move(info)) {}
  ~KnownStates() {
    for (ompl::base::State* const state : states_) info_->freeState(state);
  }
  KnownStates(const KnownStates&) = delete;
  KnownStates& operator=(const KnownStates&) = delete;

  // One more, to be set by the caller.
  ompl::base::State* add() {
    states_.push_back(info_->allocState());
    return states_.back();
  }
  [[nodiscard]] std::vector<const ompl::base::State*> all() const { return {states_.begin(), states_.end()}; }

 private:
  ompl::base::SpaceInformationPtr info_;
  std::vector<ompl::base::State*> states_;
};

}  // namespace cairn
