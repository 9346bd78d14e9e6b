// When to match (docs/method.md 4; paper section 3.1).
#pragma once

#include <map>
#include <set>

#include "maps/grid/cell.hpp"
#include "plugins/template_matcher/config.hpp"

namespace cairn::template_matcher {

// Decides for an updated cell of OG2 whether enough has become known there to match again:
// OL2 > tau_trigger, and OL2 has risen by more than tau_var since the last matching that covered
// the cell (the paper's words) or since its last update (the paper's formula). A cell that no
// matching covered yet counts as risen.
// Where some template fitted at that matching, a change of OL2 by more than tau_again is enough, and a fall
// counts as well as a rise: a landmark's cells are full long before its contour is sharp, and it is freed
// floor that sharpens it. (By the first rule only; the paper has no such thing.)
// The third rule, every_update, is what the others are measured against: each update fires, once for every
// region that it touches. Only OL2 > tau_grow is asked for, so that there is something to look at.
class Trigger {
 public:
  explicit Trigger(const Config& config)
      : rule_(config.trigger),
        min_ol_(rule_ == TriggerRule::every_update ? config.tau_grow : config.tau_trigger),
        tau_var_(config.tau_var),
        tau_again_(config.tau_again) {}

  // OG1 has changed; its updated cells follow.
  void begin_update() { covered_.clear(); }
  // Call once for each updated cell.
  [[nodiscard]] bool fires(Cell coarse, double ol);
  // A matching has covered the cell, which held this value; whether some template fitted.
  void matched(Cell coarse, double ol, bool fitted);

 private:
  struct Reference {
    double ol = 0.0;
    bool fitted = false;  // some template did, at that matching
  };

  TriggerRule rule_;
  double min_ol_;
  double tau_var_;
  double tau_again_;
  std::map<Cell, Reference> reference_;  // OL2 at the last matching or, by the second rule, update
  std::set<Cell> covered_;               // by the third rule: by matchings of this update
};

}  // namespace cairn::template_matcher
