#include "framework/program/run_pictures.hpp"

#include <map>

#include "maps/pictures/chart.hpp"
#include "maps/pictures/coarse_picture.hpp"
#include "maps/pictures/map_picture.hpp"

namespace cairn {
namespace {

void draw_map(const std::filesystem::path& file, const Mission& mission, const MissionRunner& runner) {
  MapPicture picture;
  picture.grid = &runner.grid();
  picture.graph = &runner.graph();
  picture.shapes = mission.shapes;
  for (const Pose2& pose : runner.driven_path()) picture.driven.push_back(pose.position());
  if (!runner.driven_path().empty()) {
    picture.start = runner.driven_path().front().position();
    picture.robot = runner.driven_path().back();
    picture.robot_radius_m = mission.robot.radius_m;
  }
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
  return chart;
}

}  // namespace

RunPictures draw_run(const std::filesystem::path& out, const Mission& mission, const MissionRunner& runner,
                     const RunReport& report) {
  RunPictures pictures;
  draw_map(out / "map.png", mission, runner);
  pictures.files.emplace_back("map.png");
  if (runner.coarse_grid() != nullptr) {
    CoarsePicture coarse;
    coarse.coarse = runner.coarse_grid();
    coarse.grid = &runner.grid();
    coarse.title = "OG2 of " + mission.config.mission;
    write_coarse_picture(out / "coarse.png", coarse);
    pictures.files.emplace_back("coarse.png");
  }
  if (report.degrees().empty()) return pictures;
  const ChartOutcome chart = write_chart(out / "degrees.png", chart_of(report.degrees()));
  if (chart.drawn)
    pictures.files.emplace_back("degrees.png");
  else
    pictures.missing.push_back("degrees.png: " + chart.reason);
  return pictures;
}

}  // namespace cairn
