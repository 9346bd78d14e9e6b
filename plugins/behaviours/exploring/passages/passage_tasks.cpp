#include "plugins/behaviours/exploring/passages/passage_tasks.hpp"

#include <algorithm>
#include <cstdio>

namespace cairn::behaviours {
namespace {

ExploreTask look_at(const Passage& passage, const FreeSpace& space) {
  ExploreTask task;
  task.kind = TaskKind::opening;
  task.about = passage.at_m;
  task.width_m = passage.width_m;
  task.lookout = space.centre_of(passage.lookout);
  task.path = space.path_to(passage.lookout);
  task.by_route = task.path.empty();
  return task;
}

}  // namespace

std::string sentence_of(const NotEntered& opening) {
  char text[160];
  std::snprintf(text, sizeof text, "opening at (%.2f, %.2f), %.2f m wide: %s", opening.at_m.x(), opening.at_m.y(),
                opening.width_m, opening.why.c_str());
  return text;
}

const PassageTasks::Tried* PassageTasks::find(const Point& at_m) const {
  const auto found =
      std::ranges::find_if(tried_, [&](const Tried& t) { return (t.at_m - at_m).norm() < settings_.same_m; });
  return found == tried_.end() ? nullptr : &*found;
}

std::vector<Point> PassageTasks::given_up() const {
  std::vector<Point> places;
  for (const Tried& tried : tried_)
    if (tried.is_given_up) places.push_back(tried.at_m);
  return places;
}

std::optional<ExploreTask> PassageTasks::next(const FreeSpace& space, const Explored& explored, const Point& robot) {
  const CellLayer<char> reach = reach_of(space, explored.trace);
  PassageSearch open{false, given_up()};
  while (const auto passage = nearest_passage(space, explored.grid, reach, robot, open, settings_)) {
    const bool is_looked_at = std::ranges::any_of(
        explored.looked_at, [&](const Point& p) { return (p - passage->at_m).norm() < settings_.same_m; });
    ExploreTask task = look_at(*passage, space);
    if (!is_looked_at) return task;
    if (passage->width_m < 2.0 * settings_.drive_radius_m) {
      record(task, false, "it still looks too narrow from straight before it");
      open.without.push_back(passage->at_m);
      continue;
    }
    task.kind = TaskKind::passage;
    task.lookout = passage->beyond_m;
    task.path.clear();
    task.by_route = true;
    return task;
  }
  if (suspects_ >= settings_.max_suspects) return std::nullopt;
  PassageSearch hidden{true, given_up()};
  hidden.without.insert(hidden.without.end(), open.without.begin(), open.without.end());
  hidden.without.insert(hidden.without.end(), explored.looked_at.begin(), explored.looked_at.end());
  const auto suspect = nearest_passage(space, explored.grid, reach, robot, hidden, settings_);
  if (!suspect) return std::nullopt;
  ExploreTask task = look_at(*suspect, space);
  task.is_suspect = true;
  return task;
}

void PassageTasks::record(const ExploreTask& task, bool has_passed, const std::string& why) {
  auto found =
      std::ranges::find_if(tried_, [&](const Tried& t) { return (t.at_m - task.about).norm() < settings_.same_m; });
  if (found == tried_.end()) found = tried_.insert(tried_.end(), Tried{task.about, 0, false, {}});
  ++found->tries;
  found->why = why;
  // One that was passed and is still not known to be open is not driven through for ever.
  found->is_given_up = !has_passed || found->tries >= settings_.max_tries;
}

bool PassageTasks::retry(std::vector<Point>& looked_at) {
  if (has_retried_) return false;
  has_retried_ = true;
  bool is_any = false;
  for (Tried& tried : tried_) {
    if (!tried.is_given_up || tried.why.empty() || tried.tries >= settings_.max_tries) continue;
    tried.is_given_up = false;
    std::erase_if(looked_at, [&](const Point& p) { return (p - tried.at_m).norm() < settings_.same_m; });
    is_any = true;
  }
  return is_any;
}

std::vector<NotEntered> PassageTasks::not_entered(const FreeSpace& space, const Explored& explored,
                                                  double radius_m) const {
  const CellLayer<char> reach = reach_of(space, explored.trace);
  const Point robot = explored.trace.back().position();
  std::vector<NotEntered> openings;
  PassageSearch search;
  while (const auto passage = nearest_passage(space, explored.grid, reach, robot, search, settings_)) {
    search.without.push_back(passage->at_m);
    NotEntered opening{passage->at_m, passage->width_m, passage->width_m < 2.0 * radius_m, {}};
    char text[64];
    std::snprintf(text, sizeof text, "too narrow for %.2f m", 2.0 * radius_m);
    const Tried* const tried = find(passage->at_m);
    if (tried != nullptr && tried->why.empty()) continue;  // it has been in there
    opening.why = opening.is_too_narrow ? text : tried != nullptr ? tried->why : "not tried";
    openings.push_back(opening);
  }
  return openings;
}

}  // namespace cairn::behaviours
