#include "plugins/python_module/python_detector.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/python_module/values.hpp"
#include "plugins/python_module/views.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

constexpr std::size_t kMaxSpans = 100'000;  // that wait; then their box counts

void add_to_context(py::dict& attributes, const DetectorContext& context) {
  constexpr int kCircleCorners = 72;
  py::list categories;
  py::dict outlines;
  if (context.templates) {
    for (const LandmarkShape& shape : context.templates->shapes) {
      categories.append(shape.category);
      py::list polygons;
      for (const std::vector<Point>& polygon : shape.contour.outlines_m(kCircleCorners)) {
        py::list corners;
        for (const Point& corner : polygon) corners.append(py::make_tuple(corner.x(), corner.y()));
        polygons.append(corners);
      }
      outlines[py::str(shape.category)] = polygons;
    }
  }
  attributes["categories"] = categories;
  attributes["outlines_m"] = outlines;
}

Matching matching_from(const py::handle& value, const std::string& what, const OccupancyGrid& grid) {
  const Fields fields(value, what, {"category", "pose", "degree", "found"});
  const std::string category = text_from(fields.get("category"), fields.name_of("category"));
  if (category.empty()) throw std::runtime_error(fields.name_of("category") + " is empty");
  const Pose2 pose = pose_from(fields.get("pose"), fields.name_of("pose"));
  const double degree = number_from(fields.get("degree"), fields.name_of("degree"));
  if (!(degree >= 0.0 && degree <= 1.0))
    throw std::runtime_error(fields.name_of("degree") + " must be a number from 0 to 1, found " +
                             config_detail::number_text(degree));
  const py::object found = fields.find("found");
  const bool fits = found.is_none() || flag_from(found, fields.name_of("found"));
  Matching matching;
  matching.trigger = grid.cell_at(pose.position());
  matching.region_centre_m = pose.position();
  matching.degrees = {{category, degree, pose.theta_rad, pose.position(), fits}};
  if (fits) matching.detection = Detection{category, pose, degree, {{category, pose.theta_rad, degree}}};
  return matching;
}

}  // namespace

PythonDetector::PythonDetector(const Config& config, const DetectorContext& context)
    : object_(config, context, [&](py::dict& attributes) { add_to_context(attributes, context); }, {"detect"}) {}

DetectionReport PythonDetector::detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) {
  keep(changes, grid.bounds());
  if (budget.exhausted()) return {};
  if (!changed_.empty()) examine(grid, budget);
  DetectionReport report;
  if (waiting_.empty()) return report;
  const auto count = std::min(budget.iterations, static_cast<std::int64_t>(waiting_.size()));
  const auto end = waiting_.begin() + std::max<std::int64_t>(0, count);
  report.matchings.assign(std::make_move_iterator(waiting_.begin()), std::make_move_iterator(end));
  waiting_.erase(waiting_.begin(), end);
  return report;
}

void PythonDetector::keep(const CellChanges& changes, const CellBox& bounds) {
  for (const CellSpan& span : changes.spans) {
    if (span.y < bounds.min.y || span.y >= bounds.max.y) continue;
    const CellSpan inside{span.y, std::max(span.x_begin, bounds.min.x), std::min(span.x_end, bounds.max.x)};
    if (inside.x_begin < inside.x_end) changed_.push_back(inside);
  }
  if (changed_.size() > kMaxSpans) changed_ = everything_in(CellChanges{changed_}.box()).spans;
}

void PythonDetector::examine(const OccupancyGrid& grid, const Budget& budget) {
  const ChangesView changes{std::exchange(changed_, {}), grid.bounds()};
  const std::string what = " of what " + object_.name_of("detect") + " returned";
  object_.call(&budget, [&](py::object& object) {
    const Loan loan;
    const py::object found = object.attr("detect")(whole_of({grid, loan.is_open()}), changes);
    if (found.is_none()) return;
    if (py::isinstance<py::dict>(found) || py::isinstance<py::str>(found) || !py::hasattr(found, "__iter__"))
      throw std::runtime_error(object_.name_of("detect") + " must return a list of dicts, found " + found_text(found));
    std::size_t number = 0;
    for (const py::handle matching : py::iter(found))
      waiting_.push_back(matching_from(matching, "item " + std::to_string(++number) + what, grid));
  });
}

}  // namespace cairn::python_module
