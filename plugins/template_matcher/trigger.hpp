// When to match (METHOD 4; paper section 3.1).
#pragma once

#include <map>

#include "maps/cell.hpp"
#include "plugins/template_matcher/config.hpp"

namespace cairn::template_matcher {

// Decides for an updated cell of OG2 whether enough has become known there to match again:
// OL2 > tau_trigger, and OL2 has risen by more than tau_var since the last matching that covered
// the cell (the paper's words) or since its last update (the paper's formula). A cell that no
// matching covered yet counts as risen.
class Trigger {
 public:
  Trigger(TriggerRule rule, double tau_trigger, double tau_var)
      : rule_(rule), tau_trigger_(tau_trigger), tau_var_(tau_var) {}

  // Call once for each update of a cell.
  [[nodiscard]] bool fires(Cell coarse, double ol);
  // A matching has covered the cell, which held this value.
  void matched(Cell coarse, double ol);

 private:
  TriggerRule rule_;
  double tau_trigger_;
  double tau_var_;
  std::map<Cell, double> reference_;  // OL2 at the last matching or, by the other rule, update
};

}  // namespace cairn::template_matcher
