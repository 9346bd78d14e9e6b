#include "tests/bench/association/stream.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "maps/geometry/segments.hpp"

namespace cairn::bench {
namespace {

constexpr int kVisits = 6;            // of each place
constexpr int kSightsOfVisit = 4;     // of each object
constexpr int kWrongSights = 4;       // where a scene begins with the wrong category
constexpr int kBuckets = 3;           // first, early and later sights
constexpr double kBesideRatio = 0.5;  // of the matchings that reach the neighbour too

int bucket_of(int nth) {
  return nth < 3 ? 0 : nth < 8 ? 1 : kBuckets - 1;
}

// The pose error at every sight.
class Wander {
 public:
  Wander(const PoseErrorModel& model, std::mt19937_64& random)
      : model_(model), random_(random), deviation_m_(model.error_m / std::sqrt(2.0)) {
    error_ = deviation_m_ * normal_point();
  }

  Point next(double visits) {
    const double keep = std::exp(-visits / model_.forgets_after_visits);
    error_ = keep * error_ + std::sqrt(1.0 - keep * keep) * deviation_m_ * normal_point();
    return error_;
  }

  double reported_variance_m2() const { return std::pow(model_.reported_ratio * deviation_m_, 2); }
  // How much the variance grows and is corrected in that time.
  double growth_m2(double visits) const {
    return reported_variance_m2() * (1.0 - std::exp(-2.0 * visits / model_.forgets_after_visits));
  }

 private:
  Point normal_point() {
    const double x = normal_(random_);
    return {x, normal_(random_)};
  }

  PoseErrorModel model_;
  std::mt19937_64& random_;
  std::normal_distribution<double> normal_;
  double deviation_m_;
  Point error_{0.0, 0.0};
};

std::string other_category(const std::string& category) {
  return category == "square" ? "circle" : "square";
}

// Square for circle and the other way round.
void rename(Matching& matching, const std::string& category) {
  const std::string other = other_category(category);
  const auto swap = [&](std::string& name) { name = name == category ? other : name == other ? category : name; };
  for (CategoryDegree& degree : matching.degrees) swap(degree.category);
  for (TemplateDegree& t : matching.detection->templates) swap(t.category);
  swap(matching.detection->category);
}

Matching placed(const RecordedSight& sight, const Pose2& T_map_object) {
  Matching matching;
  matching.degrees = sight.degrees;
  for (CategoryDegree& degree : matching.degrees) {
    degree.at_m = T_map_object * degree.at_m;
    degree.orientation_rad = wrap_angle(degree.orientation_rad + T_map_object.theta_rad);
  }
  matching.detection = sight.detection;
  matching.detection->T_map_landmark = T_map_object * sight.detection.T_map_landmark;
  for (TemplateDegree& t : matching.detection->templates)
    t.orientation_rad = wrap_angle(t.orientation_rad + T_map_object.theta_rad);
  return matching;
}

// A region that holds a neighbour too: the matching has the degree of what fits best there.
void add_neighbour(Matching& matching, const Matching& beside) {
  const CategoryDegree& best = *std::ranges::max_element(beside.degrees, {}, &CategoryDegree::degree);
  if (best.category == matching.detection->category) return;
  const auto own = std::ranges::find(matching.degrees, best.category, &CategoryDegree::category);
  if (own == matching.degrees.end())
    matching.degrees.push_back(best);
  else if (best.degree > own->degree)
    *own = best;
}

class Streamer {
 public:
  Streamer(const Scene& scene, const PoseErrorModel& error, const std::vector<RecordedSight>& sights,
           std::uint64_t seed)
      : scene_(scene), sights_(sights), random_(seed), wander_(error, random_), seen_(scene.objects.size(), 0) {}

  std::vector<StreamItem> run() {
    const std::vector<std::vector<int>> places = visited_together();
    for (int visit = 0; visit < kVisits; ++visit)
      for (const std::vector<int>& objects : places) {
        go_on(visit == 0 && &objects == &places.front() ? 0.0 : 1.0);
        std::vector<int> order;
        for (int i = 0; i < kSightsOfVisit; ++i) order.insert(order.end(), objects.begin(), objects.end());
        std::shuffle(order.begin(), order.end(), random_);
        for (const int object : order) {
          go_on(0.01);
          add(object, objects);
        }
      }
    return std::move(stream_);
  }

 private:
  std::vector<std::vector<int>> visited_together() const {
    std::vector<std::vector<int>> places;
    for (int i = 0; i < static_cast<int>(scene_.objects.size()); ++i) {
      const auto near = std::ranges::find_if(places, [&](const std::vector<int>& place) {
        return (at(place.front()).position() - at(i).position()).norm() <= scene_.visit_m;
      });
      if (near == places.end())
        places.push_back({i});
      else
        near->push_back(i);
    }
    return places;
  }

  const Pose2& at(int object) const { return scene_.objects[static_cast<std::size_t>(object)].T_map_object; }

  void go_on(double visits) {
    error_m_ = wander_.next(visits);
    grown_m2_ += wander_.growth_m2(visits);
  }

  Matching seen(int object, bool counts) {
    int& nth = seen_[static_cast<std::size_t>(object)];
    const SceneObject& thing = scene_.objects[static_cast<std::size_t>(object)];
    std::vector<const RecordedSight*> like;
    for (const RecordedSight& sight : sights_)
      if (sight.category == thing.category && bucket_of(sight.nth) == bucket_of(nth)) like.push_back(&sight);
    std::uniform_int_distribution<std::size_t> any(0, like.size() - 1);
    const Pose2 shifted{thing.T_map_object.x_m + error_m_.x(), thing.T_map_object.y_m + error_m_.y(),
                        thing.T_map_object.theta_rad};
    Matching matching = placed(*like[any(random_)], shifted);
    if (scene_.begins_wrong && nth < kWrongSights) rename(matching, thing.category);
    nth += counts ? 1 : 0;
    return matching;
  }

  void add(int object, const std::vector<int>& together) {
    StreamItem item{{}, seen(object, true), object};
    std::uniform_real_distribution<double> share;
    for (const int other : together)
      if (other != object && seen_[static_cast<std::size_t>(other)] > 0 && share(random_) < kBesideRatio)
        add_neighbour(item.matching, seen(other, false));
    // The reported variance is the same at all times, but what it has grown by in between is not.
    const double variance_m2 = wander_.reported_variance_m2();
    StreamItem before = item;
    before.object = -1;
    before.pose.covariance.topLeftCorner<2, 2>() = (variance_m2 + grown_m2_) * Eigen::Matrix2d::Identity();
    grown_m2_ = 0.0;
    item.pose.covariance.topLeftCorner<2, 2>() = variance_m2 * Eigen::Matrix2d::Identity();
    stream_.push_back(std::move(before));
    stream_.push_back(std::move(item));
  }

  const Scene& scene_;
  const std::vector<RecordedSight>& sights_;
  std::mt19937_64 random_;
  Wander wander_;
  std::vector<int> seen_;  // sights of each object
  std::vector<StreamItem> stream_;
  Point error_m_{0.0, 0.0};
  double grown_m2_ = 0.0;
};

}  // namespace

void write_sights(const std::filesystem::path& file, const std::vector<RecordedSight>& sights) {
  std::ofstream out(file);
  out.precision(4);
  out << "# category nth | detection: category x_m y_m angle_deg degree | degrees: category degree angle_deg x_m y_m, "
         "... | templates: category angle_deg degree, ...\n";
  for (const auto& [category, nth, detection, degrees] : sights) {
    const Pose2& at = detection.T_map_landmark;
    out << category << ' ' << nth << " | " << detection.category << ' ' << at.x_m << ' ' << at.y_m << ' '
        << cairn::degrees(at.theta_rad) << ' ' << detection.degree << " |";
    for (const CategoryDegree& d : degrees)
      out << ' ' << d.category << ' ' << d.degree << ' ' << cairn::degrees(d.orientation_rad) << ' ' << d.at_m.x()
          << ' ' << d.at_m.y();
    out << " |";
    for (const TemplateDegree& t : detection.templates)
      out << ' ' << t.category << ' ' << cairn::degrees(t.orientation_rad) << ' ' << t.degree;
    out << '\n';
  }
}

std::vector<RecordedSight> read_sights(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<RecordedSight> sights;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> parts;
    std::istringstream columns(line);
    for (std::string part; std::getline(columns, part, '|');) parts.push_back(part);
    if (parts.size() != 4) throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": not four parts");
    RecordedSight sight;
    double angle_deg = 0.0;
    std::istringstream(parts[0]) >> sight.category >> sight.nth;
    Pose2& at = sight.detection.T_map_landmark;
    std::istringstream(parts[1]) >> sight.detection.category >> at.x_m >> at.y_m >> angle_deg >> sight.detection.degree;
    at.theta_rad = radians(angle_deg);
    std::istringstream degrees(parts[2]);
    for (CategoryDegree d; degrees >> d.category >> d.degree >> angle_deg >> d.at_m.x() >> d.at_m.y();) {
      d.orientation_rad = radians(angle_deg);
      sight.degrees.push_back(d);
    }
    std::istringstream templates(parts[3]);
    for (TemplateDegree t; templates >> t.category >> angle_deg >> t.degree;) {
      t.orientation_rad = radians(angle_deg);
      sight.detection.templates.push_back(t);
    }
    sights.push_back(std::move(sight));
  }
  if (sights.empty()) throw std::runtime_error(file.string() + ": no sights");
  return sights;
}

std::vector<StreamItem> stream_of(const Scene& scene, const PoseErrorModel& error,
                                  const std::vector<RecordedSight>& sights, std::uint64_t seed) {
  return Streamer(scene, error, sights, seed).run();
}

}  // namespace cairn::bench
