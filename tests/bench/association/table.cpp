// Template sets against distance alone, which landmark is it: association_table SIGHTS FIRST_SEED COUNT
// Streams of recorded matchings (stream.hpp) in scenes of one landmark, twins, a square beside a circle and a category
// that is wrong at first; with pose errors of 0.1 to 0.6 m. One Markdown table a scene.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/experiments/statistics.hpp"
#include "framework/landmarks/tracker.hpp"
#include "tests/bench/association/stream.hpp"

namespace cairn::bench {
namespace {

constexpr double kErrors_m[] = {0.1, 0.2, 0.3, 0.4, 0.6};

// What one stream has come to.
struct Outcome {
  std::int64_t together_right = 0;  // pairs of sights in one landmark and of one object
  std::int64_t together = 0;        // pairs in one landmark
  std::int64_t of_one = 0;          // pairs of one object
  int objects = 0;
  int found = 0;           // objects with a landmark that is mostly theirs
  int right_category = 0;  // of these
  int duplicates = 0;      // landmarks beyond the first of an object
  int merged = 0;          // objects with sights, but without a landmark of their own
};

// Which landmark each sight went to, followed through confirmation and merging.
class Assignments {
 public:
  explicit Assignments(LandmarkTracker& tracker) : tracker_(tracker) {}

  void update(const StreamItem& item) {
    const std::map<LandmarkRef, int> before = sightings();
    const std::vector<LandmarkTracker::Change> changes = tracker_.update(item.matching);
    const std::map<LandmarkRef, int> after = sightings();
    for (const auto& [ref, count] : before)
      if (!after.contains(ref)) follow(ref, before, after, changes);
    std::optional<LandmarkRef> now;
    for (const auto& [ref, count] : after) {
      const auto earlier = before.find(ref);
      if (earlier == before.end() || count > earlier->second) now = ref;
    }
    if (now) sights_.emplace_back(item.object, *now);
  }

  // Object and landmark of each sight.
  std::vector<std::pair<int, LandmarkRef>> sights() const {
    std::vector<std::pair<int, LandmarkRef>> all = sights_;
    for (auto& [object, ref] : all)
      for (auto next = became_.find(ref); next != became_.end(); next = became_.find(ref)) ref = next->second;
    return all;
  }

 private:
  std::map<LandmarkRef, int> sightings() const {
    std::map<LandmarkRef, int> all;
    for (const auto& [id, landmark] : tracker_.graph().landmarks()) all[{id, false}] = landmark.sightings;
    for (const auto& [id, candidate] : tracker_.candidates().landmarks()) all[{id, true}] = candidate.sightings;
    return all;
  }

  // A landmark was merged into an older one; a candidate was confirmed, or is a known landmark.
  void follow(LandmarkRef gone, const std::map<LandmarkRef, int>& before, const std::map<LandmarkRef, int>& after,
              const std::vector<LandmarkTracker::Change>& changes) {
    if (!gone.is_candidate) {
      const std::string& reason = tracker_.graph().retired().at(gone.id).reason;
      became_[gone] = {std::stoll(reason.substr(reason.find('L') + 1)), false};
      return;
    }
    for (const LandmarkTracker::Change& change : changes)
      if (change.kind == LandmarkTracker::ChangeKind::found) became_[gone] = {change.landmark, false};
    if (became_.contains(gone)) return;
    for (const auto& [ref, count] : after)
      if (const auto earlier = before.find(ref);
          !ref.is_candidate && earlier != before.end() && count > earlier->second + 1)
        became_[gone] = ref;
  }

  LandmarkTracker& tracker_;
  std::vector<std::pair<int, LandmarkRef>> sights_;
  std::map<LandmarkRef, LandmarkRef> became_;
};

std::int64_t pairs_of(std::int64_t n) {
  return n * (n - 1) / 2;
}

Outcome judged(const Scene& scene, const LandmarkGraph& graph, const std::vector<std::pair<int, LandmarkRef>>& sights) {
  std::map<LandmarkRef, std::map<int, int>> of_landmark;
  std::map<int, int> of_object;
  for (const auto& [object, ref] : sights) {
    ++of_landmark[ref][object];
    ++of_object[object];
  }
  Outcome outcome;
  outcome.objects = static_cast<int>(scene.objects.size());
  for (const auto& [object, count] : of_object) outcome.of_one += pairs_of(count);
  std::map<int, std::vector<LandmarkId>> own;
  for (const auto& [ref, objects] : of_landmark) {
    int all = 0;
    for (const auto& [object, count] : objects) {
      outcome.together_right += pairs_of(count);
      all += count;
    }
    outcome.together += pairs_of(all);
    const auto most = std::ranges::max_element(objects, {}, [](const auto& entry) { return entry.second; });
    if (!ref.is_candidate && graph.find(ref.id) != nullptr) own[most->first].push_back(ref.id);
  }
  for (const auto& [object, landmarks] : own) {
    outcome.duplicates += static_cast<int>(landmarks.size()) - 1;
    ++outcome.found;
    const std::string& category = graph.find(landmarks.front())->category;
    outcome.right_category += category == scene.objects[static_cast<std::size_t>(object)].category ? 1 : 0;
  }
  outcome.merged = outcome.objects - outcome.found;
  return outcome;
}

Outcome run(const Scene& scene, const PoseErrorModel& error, const LandmarksConfig& config,
            const std::vector<RecordedSight>& sights, std::uint64_t seed) {
  LandmarkTracker tracker(config, RobotModel{}, scene.shapes);
  Assignments assignments(tracker);
  for (const StreamItem& item : stream_of(scene, error, sights, seed)) {
    tracker.record_pose(item.pose);
    if (item.object >= 0) assignments.update(item);
  }
  return judged(scene, tracker.graph(), assignments.sights());
}

Interval share(const std::vector<Outcome>& outcomes, std::int64_t Outcome::*part, std::int64_t Outcome::*whole) {
  return resampled(outcomes.size(), [&](std::span<const std::size_t> taken) {
    double parts = 0.0;
    double wholes = 0.0;
    for (const std::size_t i : taken) {
      parts += static_cast<double>(outcomes[i].*part);
      wholes += static_cast<double>(outcomes[i].*whole);
    }
    return wholes == 0.0 ? 1.0 : parts / wholes;
  });
}

int sum(const std::vector<Outcome>& outcomes, int Outcome::*member) {
  return std::accumulate(outcomes.begin(), outcomes.end(), 0,
                         [&](int all, const Outcome& outcome) { return all + outcome.*member; });
}

// A circle, a square and a triangle, in the size of the project's templates times a ratio.
std::vector<LandmarkShape> shapes(double ratio) {
  return {{"circle", Contour::circle(0.5 * ratio)},
          {"square", Contour::polygon({{0, 0}, {0.5 * ratio, 0}, {0.5 * ratio, 0.5 * ratio}, {0, 0.5 * ratio}})},
          {"triangle", Contour::polygon({{0, 0}, {0.6 * ratio, 0}, {0.3 * ratio, 0.519615242 * ratio}})}};
}

std::vector<Scene> scenes() {
  const auto two = [](const std::string& name, double ratio, const SceneObject& a, const SceneObject& b) {
    return Scene{name, shapes(ratio), {a, b}};
  };
  const auto square = [](double x_m, double angle_deg) {
    return SceneObject{"square", {x_m, 0.0, radians(angle_deg)}};
  };
  const SceneObject here = square(0.0, 15.0);
  return {
      {"isolated landmarks, 4 m apart", shapes(1.0), {here, {"circle", {4, 0, 0}}, {"triangle", {0, 4, 0.3}}}},
      two("twins, 1.0 m apart", 1.0, here, square(1.0, 15.0)),
      two("twins, 0.7 m apart", 1.0, here, square(0.7, 15.0)),
      two("twins, 0.5 m apart (landmarks of 0.25 m)", 0.5, here, square(0.5, 15.0)),
      two("squares 0.7 m apart, turned by 45 degrees", 1.0, here, square(0.7, 60.0)),
      two("square and circle, a gap of 0.3 m", 1.0, here, {"circle", {0.8, 0, 0}}),
      two("square and circle, centres 0.3 m apart (landmarks of 0.25 m)", 0.5, here, {"circle", {0.3, 0, 0}}),
      {"wrong category at first, 4 m apart", shapes(1.0), {here, {"circle", {4, 0, 0}}}, 2.0, true},
  };
}

void print(const Scene& scene, double reported_ratio, const std::vector<RecordedSight>& sights, int first, int count) {
  std::printf("\n### %s%s\n\n", scene.name.c_str(), reported_ratio == 1.0 ? "" : ", half of the error reported");
  std::printf("| pose error m | rule | precision | recall | duplicates | merged | right category |\n");
  std::printf("|---:|---|---:|---:|---:|---:|---:|\n");
  for (const double error_m : kErrors_m)
    for (const AssociationRule rule : {AssociationRule::template_sets, AssociationRule::distance}) {
      LandmarksConfig config;
      config.association = rule;
      std::vector<Outcome> outcomes;
      for (int seed = first; seed < first + count; ++seed)
        outcomes.push_back(
            run(scene, {error_m, 1.5, reported_ratio}, config, sights, static_cast<std::uint64_t>(seed)));
      const int objects = sum(outcomes, &Outcome::objects);
      std::printf(
          "| %.1f | %s | %s | %s | %s | %s | %s |\n", error_m,
          rule == AssociationRule::distance ? "distance" : "template sets",
          text_of(share(outcomes, &Outcome::together_right, &Outcome::together), 2).c_str(),
          text_of(share(outcomes, &Outcome::together_right, &Outcome::of_one), 2).c_str(),
          text_of(estimate_of([&] {
                    std::vector<double> each;
                    for (const Outcome& o : outcomes)
                      each.push_back(static_cast<double>(o.duplicates) / static_cast<double>(o.objects));
                    return each;
                  }()),
                  2)
              .c_str(),
          text_of(share_of(sum(outcomes, &Outcome::merged), objects), 2).c_str(),
          text_of(share_of(sum(outcomes, &Outcome::right_category), sum(outcomes, &Outcome::found)), 2).c_str());
      std::fflush(stdout);
    }
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  using namespace cairn::bench;
  if (argc != 4) {
    std::fprintf(stderr, "association_table SIGHTS FIRST_SEED COUNT\n");
    return 2;
  }
  try {
    const std::vector<RecordedSight> sights = read_sights(argv[1]);
    for (const double reported_ratio : {1.0, 0.5})
      for (const Scene& scene : scenes()) print(scene, reported_ratio, sights, std::stoi(argv[2]), std::stoi(argv[3]));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
  return 0;
}
