// Matching a 40 x 40 cell region with the templates of the office mission: the plain loop, OpenCV and
// ours, over the same patches of the mission's own maps. Rows say which patches: of all 0, without a
// landmark 1, with one 2. One core; counters: microseconds of CPU a region, and how many times faster
// than the plain loop and than OpenCV that is.
#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "plugins/template_matcher/classify.hpp"
#include "plugins/template_matcher/config.hpp"
#include "plugins/template_matcher/fast_match.hpp"
#include "tests/bench/matching_scenes.hpp"

namespace cairn::bench {
namespace {

using namespace template_matcher;

enum Patches { all_patches, without_landmark, with_landmark };

std::vector<const MatchingScene*> patches_of(std::int64_t which) {
  if (which != all_patches) return matching_scenes().with_landmark(which == with_landmark);
  std::vector<const MatchingScene*> every;
  for (const MatchingScene& scene : matching_scenes().scenes) every.push_back(&scene);
  return every;
}

const std::vector<LandmarkTemplate>& templates() {
  return matching_scenes().templates.templates;
}

CellBox box_of(const MatchingScene& scene) {
  return CellChanges{scene.region}.box();
}

std::vector<GradientField> fields_of(const std::vector<const MatchingScene*>& patches) {
  std::vector<GradientField> fields;
  for (const MatchingScene* p : patches) fields.emplace_back(p->grid, box_of(*p).grown(reach_of(templates()) + 1));
  return fields;
}

double cpu_s() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// What the rows took so far, by name and patches. The rows that come first are what the others are compared with.
std::map<std::pair<std::string, std::int64_t>, double>& times_us() {
  static std::map<std::pair<std::string, std::int64_t>, double> all;
  return all;
}

// Times one pass over all patches an iteration.
template <typename MatchOne>
void time_patches(benchmark::State& state, const std::string& name, std::size_t patches, const MatchOne& match_one) {
  const double begin_s = cpu_s();
  for (auto _ : state) {
    for (std::size_t i = 0; i < patches; ++i) match_one(i);
  }
  const double us =
      1e6 * (cpu_s() - begin_s) / (static_cast<double>(state.iterations()) * static_cast<double>(patches));
  times_us()[{name, state.range(0)}] = us;
  state.counters["us_a_region"] = us;
  state.counters["regions"] = static_cast<double>(patches);
  for (const char* other : {"plain", "opencv"}) {
    const auto found = times_us().find({other, state.range(0)});
    if (found != times_us().end() && name != other) state.counters[std::string("x_") + other] = found->second / us;
  }
}

void match_plain(benchmark::State& state) {
  const auto patches = patches_of(state.range(0));
  const auto fields = fields_of(patches);
  time_patches(state, "plain", patches.size(), [&](std::size_t i) {
    benchmark::DoNotOptimize(match_exhaustively(fields[i], patches[i]->region, templates()));
  });
}

// A picture of a template, as large as its cells reach.
cv::Mat picture_of(const LandmarkTemplate& shape) {
  const int reach = reach_of({&shape, 1});
  cv::Mat picture(2 * reach + 1, 2 * reach + 1, CV_8U, cv::Scalar(0));
  for (const TemplateCell& cell : shape.cells) {
    picture.at<std::uint8_t>(cell.offset.y + reach, cell.offset.x + reach) =
        static_cast<std::uint8_t>(std::hypot(cell.gradient_x, cell.gradient_y) / 6.0);
  }
  return picture;
}

// OL as bytes: the fastest kind of picture that OpenCV's function takes.
cv::Mat picture_of(const OccupancyGrid& grid, const CellBox& box) {
  cv::Mat picture(box.height(), box.width(), CV_8U);
  grid.copy_ol(box, {picture.data, picture.total()});
  return picture;
}

void match_opencv(benchmark::State& state) {
  cv::setNumThreads(1);
  const auto patches = patches_of(state.range(0));
  const int reach = reach_of(templates());
  std::vector<cv::Mat> shapes;
  std::vector<cv::Mat> pictures;
  for (const LandmarkTemplate& t : templates()) shapes.push_back(picture_of(t));
  for (const MatchingScene* p : patches) pictures.push_back(picture_of(p->grid, box_of(*p).grown(reach)));
  time_patches(state, "opencv", patches.size(), [&](std::size_t i) {
    for (const cv::Mat& shape : shapes) {
      const int margin = reach - shape.rows / 2;
      const int side = pictures[i].rows - 2 * margin;
      cv::Mat fits;
      cv::matchTemplate(pictures[i](cv::Rect(margin, margin, side, side)), shape, fits, cv::TM_CCOEFF_NORMED);
      double best = 0.0;
      cv::Point at;
      cv::minMaxLoc(fits, nullptr, &best, nullptr, &at);
      benchmark::DoNotOptimize(best);
    }
  });
}

void time_fast(benchmark::State& state, const std::string& name, const std::vector<std::int32_t>& ceilings) {
  const auto patches = patches_of(state.range(0));
  const auto fields = fields_of(patches);
  FastMatcher matcher(templates());
  time_patches(state, name, patches.size(), [&](std::size_t i) {
    benchmark::DoNotOptimize(matcher.match(fields[i], patches[i]->region, ceilings));
  });
}

void match_above_threshold(benchmark::State& state) {
  const Config config;  // as missions have it by default
  const double mu = 255.0 * std::sqrt(20.0);
  std::vector<std::int32_t> ceilings;
  for (const LandmarkTemplate& t : templates()) {
    ceilings.push_back(mismatch_ceiling(config.tau_match - config.min_margin, t.cells.size(), mu));
  }
  time_fast(state, "above_threshold", ceilings);
}

void match_every_template(benchmark::State& state) {
  time_fast(state, "every_template", std::vector<std::int32_t>(templates().size(), kUnmatched));
}

void gradients_of_a_region(benchmark::State& state) {
  const auto patches = patches_of(state.range(0));
  const int reach = reach_of(templates());
  GradientField field;  // keeps its memory, as the detector's does
  time_patches(state, "gradients", patches.size(), [&](std::size_t i) {
    field.look_at(patches[i]->grid, box_of(*patches[i]).grown(reach + 1));
    benchmark::DoNotOptimize(field.x_from(field.box().min));
  });
}

BENCHMARK(match_plain)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(match_opencv)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(match_above_threshold)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(match_every_template)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(gradients_of_a_region)->Arg(0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn::bench
