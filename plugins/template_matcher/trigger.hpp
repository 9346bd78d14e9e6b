// When to match (METHOD 4; paper section 3.1).
#pragma once

#include <map>
#include <set>

#include "maps/cell.hpp"
#include "plugins/template_matcher/config.hpp"

namespace cairn::template_matcher {

// Decides for an updated cell of OG2 whether enough has become known there to match again:
// OL2 > tau_trigger, and OL2 has risen by more than tau_var since the last matching that covered
// the cell (the paper's words) or since its last update (the paper's formula). A cell that no
// matching covered yet counts as risen.
// The third rule, every_update, is what the others are measured against: each update fires, once for every
// region that it touches. Only OL2 > tau_grow is asked for, so that there is something to look at.
class Trigger {
 public:
  explicit Trigger(const Config& config)
      : rule_(config.trigger),
        least_ol_(rule_ == TriggerRule::every_update ? config.tau_grow : config.tau_trigger),
        tau_var_(config.tau_var) {}

  // OG1 has changed; its updated cells follow.
  void begin_update() { covered_.clear(); }
  // Call once for each updated cell.
  [[nodiscard]] bool fires(Cell coarse, double ol);
  // A matching has covered the cell, which held this value.
  void matched(Cell coarse, double ol);

 private:
  TriggerRule rule_;
  double least_ol_;
  double tau_var_;
  std::map<Cell, double> reference_;  // OL2 at the last matching or, by the second rule, update
  std::set<Cell> covered_;            // by the third rule: by matchings of this update
};

}  // namespace cairn::template_matcher
