#include "plugins/behaviours/exploring/passages/passage_tasks.hpp"

#include <algorithm>
#include <cstdio>

#include "plugins/behaviours/places/map_watch.hpp"
#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

std::string too_narrow(double radius_m) {
  char text[64];
  std::snprintf(text, sizeof text, "too narrow for %.2f m", 2.0 * radius_m);
  return text;
}

}  // namespace

std::string sentence_of(const NotEntered& opening) {
  constexpr double kShut_m = 0.005;  // would be written as 0.00 m
  char width[32] = "drawn shut in the map";
  if (opening.width_m >= kShut_m) std::snprintf(width, sizeof width, "%.2f m wide", opening.width_m);
  char text[240];
  std::snprintf(text, sizeof text, "opening at (%.2f, %.2f), %s: %s", opening.at_m.x(), opening.at_m.y(), width,
                opening.why.c_str());
  return text;
}

// The nearest: where a middle was heard beside where the map has it, two may come to lie close together.
const PassageTasks::Tried* PassageTasks::find(const Point& at_m) const {
  const auto away_m = [&](const Tried& tried) { return (tried.at_m - at_m).norm(); };
  const auto nearest = std::ranges::min_element(tried_, {}, away_m);
  return nearest == tried_.end() || away_m(*nearest) >= settings_.same_m ? nullptr : &*nearest;
}

const PassageTasks::Tried* PassageTasks::given_up_beside(const Point& at_m) const {
  const Tried* nearest = nullptr;
  double nearest_m = 2.0 * settings_.same_m;
  for (const Tried& tried : tried_) {
    const double away_m = (tried.at_m - at_m).norm();
    if (!tried.is_given_up || tried.was_passed || away_m >= nearest_m) continue;
    nearest = &tried;
    nearest_m = away_m;
  }
  return nearest;
}

PassageTasks::Tried& PassageTasks::at(const Point& at_m) {
  if (const Tried* const known = find(at_m)) return tried_[static_cast<std::size_t>(known - tried_.data())];
  Tried& tried = tried_.emplace_back();
  tried.at_m = at_m;
  return tried;
}

std::vector<Point> PassageTasks::places_where(bool (*is_so)(const Tried&)) const {
  std::vector<Point> places;
  for (const Tried& tried : tried_)
    if (is_so(tried)) places.push_back(tried.at_m);
  return places;
}

ExploreTask PassageTasks::drive_through(const HeardOpening& heard, double radius_m) const {
  ExploreTask task;
  task.kind = TaskKind::passage;
  task.about = heard.middle_m;
  task.width_m = heard.width_m;
  const Point ahead = (heard.middle_m - heard.from_m).normalized();
  task.lookout = heard.from_m;
  task.beyond_m = heard.middle_m + (radius_m + drive_.past_m) * ahead;
  return task;
}

std::optional<ExploreTask> PassageTasks::next(const Explored& explored, const Point& robot) {
  const CellLayer<char> reach = reach_of(explored.space, explored.trace);
  const auto look_at = [&](const Passage& passage) {
    ExploreTask task;
    task.kind = TaskKind::opening;
    task.about = passage.at_m;
    task.width_m = passage.width_m;
    task.lookout = explored.space.centre_of(passage.lookout);
    task.path = explored.space.path_to(passage.lookout);
    return task;
  };
  PassageSettings settings = settings_;
  if (has_retried_) settings.look_from_m = settings_.look_again_from_m;
  PassageSearch open{false, places_where([](const Tried& t) { return t.is_given_up; })};
  if (const auto passage = nearest_passage(explored.map, explored.passed, reach, robot, open, settings)) {
    const Tried* const tried = find(passage->at_m);
    if (tried == nullptr || !tried->heard) return look_at(*passage);
    ExploreTask task = drive_through(*tried->heard, explored.radius_m);
    task.path = explored.space.path_to(explored.space.cell_at(task.lookout));
    return task;
  }
  if (suspects_ >= settings_.max_suspects) return next_dare(explored);
  PassageSearch hidden{true, looked_at()};
  const auto suspect = nearest_passage(explored.map, explored.passed, reach, robot, hidden, settings_);
  if (!suspect) return next_dare(explored);
  ExploreTask task = look_at(*suspect);
  task.is_suspect = true;
  return task;
}

bool PassageTasks::is_worth_daring(const HeardOpening& heard, double radius_m) const {
  return heard.is_heard && heard.width_m >= settings_.dared_ratio * 2.0 * radius_m;
}

// Those that the map draws shut, so that no search finds them again.
std::optional<ExploreTask> PassageTasks::next_dare(const Explored& explored) {
  if (!has_retried_) return std::nullopt;
  for (Tried& tried : tried_) {
    if (tried.is_given_up || !tried.is_too_narrow) continue;
    if (!tried.heard) tried.heard = tried.heard_before;
    tried.is_given_up = !tried.heard || !is_worth_daring(*tried.heard, explored.radius_m);
    if (tried.is_given_up) continue;
    ExploreTask task = drive_through(*tried.heard, explored.radius_m);
    task.path = explored.space.path_to(explored.space.cell_at(task.lookout));
    return task;
  }
  return std::nullopt;
}

void PassageTasks::record_unreachable(const ExploreTask& task) {
  Tried& tried = at(task.about);
  tried.is_given_up = true;
  tried.is_unreachable = true;
  tried.why = "no path leads to it";
}

std::optional<ExploreTask> PassageTasks::record_look(const ExploreTask& task, const HeardOpening& heard,
                                                     double radius_m) {
  suspects_ += task.is_suspect ? 1 : 0;
  Tried& tried = at(task.about);
  tried.heard = heard;
  tried.is_unreachable = false;
  tried.is_given_up = false;
  if (!heard.is_heard) {  // without a sonar that looks there, the map is all that is known
    tried.heard->width_m = task.width_m;
    tried.heard->middle_m = task.about;
  }
  if (tried.heard_before && tried.heard_before->width_m > tried.heard->width_m) tried.heard = tried.heard_before;
  tried.is_suspect = task.is_suspect;
  tried.at_m = tried.heard->middle_m;
  const double min_clearance_m =
      drive_.clearances_m.empty() ? 0.0 : *std::min_element(drive_.clearances_m.begin(), drive_.clearances_m.end());
  tried.is_too_narrow = tried.heard->width_m + drive_.width_error_m < 2.0 * (radius_m + min_clearance_m);
  // What was heard is the least that is open. When nothing else is left a drive tells.
  const bool is_dared = has_retried_ && tried.tries == 0 && is_worth_daring(*tried.heard, radius_m);
  if (!tried.is_too_narrow || is_dared) return drive_through(*tried.heard, radius_m);
  tried.is_given_up = true;
  tried.why = too_narrow(radius_m);
  return std::nullopt;
}

void PassageTasks::forget_unreachable() {
  for (Tried& tried : tried_) {
    if (!tried.is_unreachable) continue;
    tried.is_unreachable = false;
    tried.is_given_up = false;
  }
}

void PassageTasks::record(const ExploreTask& task, bool has_passed, const std::string& why) {
  if (has_passed) forget_unreachable();
  Tried& tried = at(task.about);
  ++tried.tries;
  tried.passes += has_passed ? 1 : 0;
  tried.failures = has_passed ? 0 : tried.failures + 1;
  tried.is_too_narrow = tried.is_too_narrow && !has_passed;
  if (!tried.is_too_narrow) tried.why = why;
  tried.was_passed = tried.was_passed || has_passed;
  // One that was passed and is still not known to be open is not driven through for ever.
  tried.is_given_up = !has_passed || tried.tries >= settings_.max_tries;
  if (has_passed || !has_retried_) return;
  if (tried.is_too_narrow)
    dare_beside(tried);
  else if (tried.tries < settings_.max_tries)
    look_again(tried);
}

// What was heard may lie at either side of what is open.
void PassageTasks::dare_beside(Tried& tried) {
  constexpr double kBeside_m = 0.12;
  constexpr int kDares = 3;  // in the middle, then beside it
  if (tried.tries >= kDares || !tried.heard) return;
  HeardOpening& heard = *tried.heard;
  const Point ahead = (heard.middle_m - heard.from_m).normalized();
  const Point aside_m = (tried.tries == 1 ? kBeside_m : -2.0 * kBeside_m) * Point(-ahead.y(), ahead.x());
  heard.middle_m += aside_m;
  heard.from_m += aside_m;
  tried.at_m = heard.middle_m;
  tried.is_given_up = false;
}

std::optional<ExploreTask> PassageTasks::passed_on(const std::vector<Point>& path, double radius_m) const {
  constexpr double kStep_m = 0.05;
  const double length_m = length_of(path);
  for (double s = 0.0; s < length_m; s += kStep_m) {
    const Point p = motion::point_along(path, s);
    for (const Tried& tried : tried_) {
      const bool is_blocked = tried.failures >= settings_.max_tries;  // now
      const bool is_in_vain = tried.passes >= settings_.max_passes;   // what is behind it is not got to by this way
      if (!tried.was_passed || is_blocked || is_in_vain || !tried.heard ||
          (p - tried.heard->middle_m).norm() > 0.5 * tried.heard->width_m)
        continue;
      HeardOpening through = *tried.heard;
      const Point ahead = motion::point_along(path, std::min(length_m, s + radius_m)) - p;
      if (ahead.dot(through.middle_m - through.from_m) < 0.0)  // back
        through.from_m = 2.0 * through.middle_m - through.from_m;
      // A robot that has just come through stands that near behind it, and goes on.
      const Point before = motion::point_along(path, std::max(0.0, s - radius_m));
      const bool is_behind = (before - through.middle_m).dot(through.middle_m - through.from_m) > 0.0;
      if (!is_behind) return drive_through(through, radius_m);
    }
  }
  return std::nullopt;
}

// A look that led to a drive which was blocked may have heard the middle elsewhere than it is.
void PassageTasks::look_again(Tried& tried) {
  tried.is_given_up = false;
  tried.heard_before = tried.tries > 0 ? std::nullopt : tried.heard;
  tried.heard.reset();
}

bool PassageTasks::retry() {
  if (has_retried_) return false;
  has_retried_ = true;
  bool is_any = false;
  for (Tried& tried : tried_) {
    is_any = is_any || tried.is_unreachable || tried.failures >= settings_.max_tries;
    tried.failures = 0;
    if (!tried.is_given_up || tried.was_passed || !tried.heard || tried.tries >= settings_.max_tries) continue;
    if (tried.is_suspect && tried.heard->width_m <= 0.0) continue;  // a wall
    look_again(tried);
    is_any = true;
  }
  forget_unreachable();
  return is_any;
}

void PassageTasks::move(const MapMove& move) {
  for (Tried& tried : tried_) {
    move_place(move, tried.at_m);
    for (std::optional<HeardOpening>* const heard : {&tried.heard, &tried.heard_before}) {
      if (!*heard) continue;
      const Pose2 T = move.near((*heard)->middle_m);  // one for both: its line keeps its direction
      (*heard)->from_m = T * (*heard)->from_m;
      (*heard)->middle_m = T * (*heard)->middle_m;
    }
  }
}

std::vector<NotEntered> PassageTasks::not_entered(const Explored& explored) const {
  const CellLayer<char> reach = reach_of(explored.space, explored.trace);
  const Point robot = explored.trace.back().position();
  std::vector<NotEntered> openings;
  PassageSearch search;
  while (const auto passage = nearest_passage(explored.map, explored.passed, reach, robot, search, settings_)) {
    search.without.push_back(passage->at_m);
    NotEntered opening{passage->at_m, passage->width_m, false, "not tried"};
    const Tried* tried = find(passage->at_m);
    if (tried == nullptr) tried = given_up_beside(passage->at_m);
    if (tried != nullptr) {
      if (tried->was_passed) continue;  // it has been in there
      if (tried->heard) opening.width_m = tried->heard->width_m;
      opening.is_too_narrow = tried->is_too_narrow;
      opening.why = tried->why;
    }
    openings.push_back(opening);
  }
  PassageSearch hidden{true, looked_at()};
  for (const NotEntered& opening : openings) hidden.without.push_back(opening.at_m);
  while (const auto wall = nearest_passage(explored.map, explored.passed, reach, robot, hidden, settings_)) {
    hidden.without.push_back(wall->at_m);
    if (wall->behind_m2 >= std::max(settings_.missed_m2, settings_.room_behind_m2))
      openings.push_back({wall->at_m, 0.0, false, "drawn shut, though echoes have passed it, and not looked at"});
  }
  return openings;
}

double PassageTasks::suspected_m2(const Explored& explored) const {
  const CellLayer<char> reach = reach_of(explored.space, explored.trace);
  return seen_behind_walls_m2(explored.map, explored.passed, reach, looked_at(), settings_);
}

}  // namespace cairn::behaviours
