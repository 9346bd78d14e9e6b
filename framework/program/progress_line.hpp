// Progress of a run for people: one line that is drawn again and again on a terminal, and the events
// that matter as lines of their own.
#pragma once

#include <ostream>

#include "framework/host/events.hpp"

namespace cairn {

class ProgressLine : public Listener {
 public:
  // live: draw the moving line (out is a terminal).
  ProgressLine(std::ostream& out, bool live) : out_(out), live_(live) {}
  ~ProgressLine() override { clear(); }

  void on(const Event& event, const MissionView& view) override;

 private:
  void clear();
  void draw(const WorldView& world);

  std::ostream& out_;
  bool live_;
  bool drawn_ = false;
  double drawn_at_s_ = -1.0;
  int matchings_ = 0;
};

}  // namespace cairn
