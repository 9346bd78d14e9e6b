#include "framework/program/run/pictures.hpp"

#include <algorithm>
#include <map>

#include "framework/program/run/timeline_picture.hpp"
#include "maps/pictures/coarse_picture.hpp"
#include "maps/pictures/drawing/chart.hpp"
#include "maps/pictures/saved_map_picture.hpp"

namespace cairn {
namespace {

void add_traffic(const World& world, MapPicture& picture) {
  for (const WorldDoor& door : world.doors) picture.doors.push_back({door.from_m, door.to_m});
  for (const WorldMover& mover : world.movers) {
    picture.mover_paths.push_back(mover.path_m);
    if (mover.course == Course::round) picture.mover_paths.back().push_back(mover.path_m.front());
  }
}

void draw_map(const std::filesystem::path& file, const Mission& mission, const MissionRunner& runner,
              const MissionResult& result, const RunReport& report) {
  MapPicture picture;
  picture.grid = runner.grid();
  picture.graph = &runner.graph();
  picture.clusters = &result.clusters;
  picture.shapes = mission.shapes;
  for (const Pose2& pose : runner.driven_path()) picture.driven.push_back(pose.position());
  if (!runner.driven_path().empty()) {
    picture.start = runner.driven_path().front().position();
    picture.robot = runner.driven_path().back();
    picture.robot_radius_m = mission.robot.radius_m;
  }
  for (const NearMiss& miss : report.near_misses().away_from(runner.graph()))
    if (miss.is_close()) picture.near_misses.push_back({miss.at_m, words_about(miss)});
  if (mission.world) add_traffic(*mission.world, picture);
  picture.title = mission.config.mission + ", seed " + std::to_string(mission.config.seed);
  write_map_picture(file, picture);
}

Chart chart_of(const std::vector<DegreeSample>& samples) {
  std::map<std::string, Series> series;
  for (const DegreeSample& sample : samples)
    for (const CategoryDegree& degree : sample.degrees) {
      Series& line = series[degree.category];
      line.name = degree.category;
      line.style = SeriesStyle::points;
      line.points.emplace_back(sample.time_s, degree.degree);
    }
  Chart chart;
  chart.title = "Best matching degree of each category";
  chart.x_label = "time, s";
  chart.y_label = "degree";
  for (auto& [category, line] : series) chart.series.push_back(std::move(line));
  if (!samples.empty() && samples.back().fits_above)
    chart.horizontal_lines = {{"a match counts above", *samples.back().fits_above}};
  return chart;
}

Chart chart_of(const std::vector<PoseErrorSample>& samples) {
  Series error{"estimate against truth", {}, SeriesStyle::lines, {}};
  for (const PoseErrorSample& sample : samples) error.points.emplace_back(sample.time_s, sample.error_m);
  Chart chart;
  chart.title = "Error of the position";
  chart.x_label = "time, s";
  chart.y_label = "m";
  chart.series.push_back(std::move(error));
  return chart;
}

void draw_chart(const std::filesystem::path& file, const Chart& chart) {
  const ChartOutcome outcome = write_chart(file, chart);
  if (!outcome.drawn) throw std::runtime_error(outcome.reason);
}

}  // namespace

void draw_saved_map(const std::filesystem::path& file, const SavedMap& map, const std::string& title) {
  MapPicture picture = picture_of(map);
  picture.title = title;
  write_map_picture(file, picture);
}

void draw_over_truth(const std::filesystem::path& file, const SavedMap& map, const DrawnTruth& truth,
                     const std::string& title) {
  constexpr double kLongerSide_px = 560.0;
  constexpr int kCircleCorners = 36;
  MapPicture picture;
  picture.grid = &map.grid;
  picture.longer_side_px = kLongerSide_px;
  picture.has_three_greys = true;
  picture.doors = truth.doors;
  picture.areas = truth.not_entered;
  for (const WorldWall& wall : truth.world->walls) picture.truth.push_back(wall.points_m);
  for (const WorldObject& object : truth.world->objects)
    for (std::vector<Point> outline : object.contour.outlines_m(kCircleCorners)) {
      for (Point& p : outline) p = object.T_map_object * p;
      outline.push_back(outline.front());
      picture.truth.push_back(std::move(outline));
    }
  for (const Pose2& pose : map.driven_path) picture.driven.push_back(pose.position());
  if (!picture.driven.empty()) picture.start = picture.driven.front();
  picture.title = title;
  write_map_picture(file, picture);
}

RunPictures draw_run(const std::filesystem::path& out, const Mission& mission, const MissionRunner& runner,
                     const MissionResult& result, const RunReport& report) {
  RunPictures pictures;
  // A picture that cannot be drawn must not cost the report.
  const auto attempt = [&](const std::string& name, auto draw) {
    try {
      draw(out / name);
      pictures.files.push_back(name);
    } catch (const std::exception& error) {
      pictures.missing.push_back(name + ": " + error.what());
    }
  };
  if (runner.grid() == nullptr) {
    pictures.missing.emplace_back("map.png: the module that held the map was given up");
  } else {
    attempt("map.png", [&](const std::filesystem::path& file) { draw_map(file, mission, runner, result, report); });
  }
  if (runner.coarse_grid() != nullptr)
    attempt("coarse.png", [&](const std::filesystem::path& file) {
      CoarsePicture coarse;
      coarse.coarse = runner.coarse_grid();
      coarse.grid = runner.grid();
      coarse.title = mission.config.mission + ", coarse grid (OG2)";
      write_coarse_picture(file, coarse);
    });
  // A detector may report nothing below its threshold.
  if (std::ranges::any_of(report.degrees(), [](const DegreeSample& sample) { return !sample.degrees.empty(); }))
    attempt("degrees.png", [&](const std::filesystem::path& file) { draw_chart(file, chart_of(report.degrees())); });
  if (const auto& errors = report.pose_errors().samples(); !errors.empty())
    attempt("pose_error.png", [&](const std::filesystem::path& file) { draw_chart(file, chart_of(errors)); });
  if (!result.node_runs.runs().empty())
    attempt("timeline.png", [&](const std::filesystem::path& file) {
      write_timeline_picture(file, timeline_of(mission, result, report.timeline()));
    });
  return pictures;
}

}  // namespace cairn
