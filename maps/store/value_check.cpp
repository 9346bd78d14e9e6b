#include "maps/store/value_check.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "maps/base/printable.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/store/file.hpp"
#include "maps/store/schema.hpp"
#include "maps/store/sqlite.hpp"
#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/trajectory.hpp"

namespace cairn::store {
namespace {

constexpr double kMaxPlace_m = 1e6;     // from the origin of the grid
constexpr double kMaxImported_m = 1e9;  // in a map without cells, whose places come from a graph file
constexpr double kMaxAngle_rad = 1e6;   // graph files may count turns
constexpr double kMaxTime_s = 1e9;
constexpr double kMaxSpeed_mps = 1e3;
constexpr double kMaxSize_m = 1e3;        // of a shape
constexpr double kMaxInformation = 1e15;  // of 1 / m2 and 1 / rad2: far better than anything measures
constexpr double kAnyFinite = std::numeric_limits<double>::max();
constexpr auto kMaxIdValue = static_cast<double>(kMaxId);
constexpr double kMaxCount = 2147483647.0;
constexpr double kMaxCell = 131072.0;

enum class From { zero, grid_x, grid_y };  // what a range counts from

struct ColumnRange {
  const char* table;
  const char* column;
  double min;
  double max;
  From from = From::zero;
};

constexpr std::array kRanges{
    ColumnRange{"grid", "cell_m", 1e-6, 1000.0},
    ColumnRange{"grid", "origin_x_m", -kMaxImported_m, kMaxImported_m},
    ColumnRange{"grid", "origin_y_m", -kMaxImported_m, kMaxImported_m},
    ColumnRange{"grid", "clamp_nat", 0.0, 127.0},
    ColumnRange{"grid", "min_x", -kMaxCell, kMaxCell},
    ColumnRange{"grid", "min_y", -kMaxCell, kMaxCell},
    ColumnRange{"grid", "max_x", -kMaxCell, kMaxCell},
    ColumnRange{"grid", "max_y", -kMaxCell, kMaxCell},
    ColumnRange{"routes", "id", 1.0, kMaxIdValue},
    ColumnRange{"routes", "level", -1e6, 1e6},
    ColumnRange{"routes", "from_landmark", 1.0, kMaxIdValue},
    ColumnRange{"routes", "to_landmark", 1.0, kMaxIdValue},
    ColumnRange{"routes", "cost_m", 0.0, kAnyFinite},
    ColumnRange{"routes", "driven", 0.0, 1.0},
    ColumnRange{"routes", "closed", 0.0, 1.0},
    ColumnRange{"routes", "poses", 0.0, 1e7},
    ColumnRange{"routes", "speed_limit_mps", 0.0, kMaxSpeed_mps},
    ColumnRange{"clusters", "id", 1.0, kMaxIdValue},
    ColumnRange{"clusters", "level", 1.0, 64.0},
    ColumnRange{"clusters", "parent", 0.0, kMaxIdValue},
    ColumnRange{"clusters", "anchor", 1.0, kMaxIdValue},
    ColumnRange{"landmark_clusters", "landmark", 1.0, kMaxIdValue},
    ColumnRange{"landmark_clusters", "cluster", 1.0, kMaxIdValue},
    ColumnRange{"next_ids", "id", 1.0, kMaxIdValue + 1.0},
    ColumnRange{"driven_path", "x_m", -kMaxPlace_m, kMaxPlace_m, From::grid_x},
    ColumnRange{"driven_path", "y_m", -kMaxPlace_m, kMaxPlace_m, From::grid_y},
    ColumnRange{"driven_path", "theta_rad", -kMaxAngle_rad, kMaxAngle_rad},
    ColumnRange{"progress", "time_s", 0.0, kMaxTime_s},
    ColumnRange{"progress", "step", 0.0, kMaxCount},
    ColumnRange{"progress", "x_m", -kMaxPlace_m, kMaxPlace_m, From::grid_x},
    ColumnRange{"progress", "y_m", -kMaxPlace_m, kMaxPlace_m, From::grid_y},
    ColumnRange{"progress", "theta_rad", -kMaxAngle_rad, kMaxAngle_rad},
    ColumnRange{"progress", "true_x_m", -kMaxPlace_m, kMaxPlace_m, From::grid_x},
    ColumnRange{"progress", "true_y_m", -kMaxPlace_m, kMaxPlace_m, From::grid_y},
    ColumnRange{"progress", "true_theta_rad", -kMaxAngle_rad, kMaxAngle_rad},
    ColumnRange{"progress", "distance_m", 0.0, kMaxImported_m},
    ColumnRange{"progress", "readings", 0.0, kMaxIdValue},
    ColumnRange{"progress", "matchings", 0.0, kMaxIdValue},
    ColumnRange{"progress", "collisions", 0.0, kMaxIdValue},
    ColumnRange{"submap_nodes", "stamp_s", 0.0, kMaxTime_s},
    ColumnRange{"submap_nodes", "x_m", -kMaxPlace_m, kMaxPlace_m, From::grid_x},
    ColumnRange{"submap_nodes", "y_m", -kMaxPlace_m, kMaxPlace_m, From::grid_y},
    ColumnRange{"submap_nodes", "theta_rad", -kMaxAngle_rad, kMaxAngle_rad},
    ColumnRange{"submap_edges", "x_m", -kMaxPlace_m, kMaxPlace_m},
    ColumnRange{"submap_edges", "y_m", -kMaxPlace_m, kMaxPlace_m},
    ColumnRange{"submap_edges", "theta_rad", -kMaxAngle_rad, kMaxAngle_rad},
    ColumnRange{"submap_edges", "xx", 0.0, kMaxInformation},
    ColumnRange{"submap_edges", "yy", 0.0, kMaxInformation},
    ColumnRange{"submap_edges", "tt", 0.0, kMaxInformation},
    ColumnRange{"submap_edges", "xy", -kMaxInformation, kMaxInformation},
    ColumnRange{"submap_edges", "xt", -kMaxInformation, kMaxInformation},
    ColumnRange{"submap_edges", "yt", -kMaxInformation, kMaxInformation},
};

// Of landmarks, retired_landmarks and candidates.
constexpr std::array kLandmarkRanges{
    ColumnRange{"", "id", 1.0, kMaxIdValue},
    ColumnRange{"", "level", -1e6, 1e6},
    ColumnRange{"", "x_m", -kMaxPlace_m, kMaxPlace_m, From::grid_x},
    ColumnRange{"", "y_m", -kMaxPlace_m, kMaxPlace_m, From::grid_y},
    ColumnRange{"", "theta_rad", -kMaxAngle_rad, kMaxAngle_rad},
    ColumnRange{"", "degree", 0.0, 1.0},
    ColumnRange{"", "sightings", 0.0, kMaxCount},
    ColumnRange{"", "access_x_m", -kMaxPlace_m, kMaxPlace_m, From::grid_x},
    ColumnRange{"", "access_y_m", -kMaxPlace_m, kMaxPlace_m, From::grid_y},
    ColumnRange{"", "access_theta_rad", -kMaxAngle_rad, kMaxAngle_rad},
};
// Of the tables _templates and _evidence of landmarks and candidates.
constexpr std::array kTemplateRanges{
    ColumnRange{"", "landmark", 1.0, kMaxIdValue},
    ColumnRange{"", "rank", 1.0, kMaxCount},
    ColumnRange{"", "orientation_rad", -kMaxAngle_rad, kMaxAngle_rad},
    ColumnRange{"", "degree", 0.0, 1.0},
};
constexpr std::array kEvidenceRanges{
    ColumnRange{"", "landmark", 1.0, kMaxIdValue}, ColumnRange{"", "matchings", 0.0, kMaxCount},
    ColumnRange{"", "mean_degree", 0.0, 1.0},      ColumnRange{"", "best_degree", 0.0, 1.0},
    ColumnRange{"", "last_degree", 0.0, 1.0},
};

// Numbers that are kept as text.
struct PropertyRange {
  const char* key;
  double min;
  double max;
};
constexpr std::array kProperties{
    PropertyRange{"paused_s", 0.0, kMaxTime_s},  // no part of the mission's clock
    PropertyRange{"robot_radius_m", 0.0, 10.0},
};

// Table and column.
using Name = std::pair<const char*, const char*>;
constexpr std::array kNames{Name{"landmarks", "name"},
                            Name{"landmarks", "category"},
                            Name{"retired_landmarks", "name"},
                            Name{"retired_landmarks", "category"},
                            Name{"candidates", "name"},
                            Name{"candidates", "category"},
                            Name{"landmark_templates", "category"},
                            Name{"landmark_evidence", "category"},
                            Name{"candidate_templates", "category"},
                            Name{"candidate_evidence", "category"},
                            Name{"clusters", "name"},
                            Name{"shapes", "category"},
                            Name{"progress", "step_name"}};

class ValueCheck {
 public:
  explicit ValueCheck(Database& database) : database_(database) {}

  std::vector<ValueFinding> run() {
    attempt([&] { read_origin(); });
    for (const ColumnRange& range : kRanges) check(range.table, range);
    for (const char* table : {"landmarks", "retired_landmarks", "candidates"})
      for (const ColumnRange& range : kLandmarkRanges) check(table, range);
    for (const std::string whose : {"landmark", "candidate"}) {
      for (const ColumnRange& range : kTemplateRanges) check(whose + "_templates", range);
      for (const ColumnRange& range : kEvidenceRanges) check(whose + "_evidence", range);
    }
    for (const auto& [table, column] : kNames) check_names(table, column);
    attempt([&] { check_trajectories(); });
    attempt([&] { check_shapes(); });
    for (const PropertyRange& range : kProperties) attempt([&] { check_property(range); });
    attempt([&] { check_edges(); });
    return std::move(findings_);
  }

 private:
  // What cannot be read is damage, which is reported elsewhere.
  template <class Work>
  static void attempt(const Work& work) {
    try {
      work();
    } catch (const StoreError&) {
      return;
    }
  }

  void read_origin() {
    Statement row(database_, "SELECT origin_x_m, origin_y_m, max_x > min_x FROM grid");
    if (!row.step()) return;
    has_cells_ = row.integer(2) != 0;
    if (has_cells_) origin_m_ = {row.real(0), row.real(1)};
  }

  void add(const std::string& table, const std::string& row, const std::string& column, const std::string& what) {
    if (findings_.size() < kMaxFindings) findings_.push_back({table, row, column, what});
  }

  [[nodiscard]] std::pair<double, double> limits_of(const ColumnRange& range) const {
    if (range.from == From::zero) return {range.min, range.max};
    if (!has_cells_) return {-kMaxImported_m, kMaxImported_m};
    const double from = range.from == From::grid_x ? origin_m_.x() : origin_m_.y();
    return {from + range.min, from + range.max};
  }

  // The first column; empty: no such table.
  std::string key_of(const std::string& table) {
    Statement key(database_, "SELECT name FROM pragma_table_info('" + table + "') ORDER BY cid LIMIT 1");
    return key.step() ? key.text(0) : "";
  }

  void check(const std::string& table, const ColumnRange& range) {
    attempt([&] {
      const auto [min, max] = limits_of(range);
      const std::string column = range.column;
      const std::string key = key_of(table);
      if (key.empty()) return;
      Statement row(database_, "SELECT " + key + ", substr(CAST(" + column + " AS TEXT), 1, 40) FROM " + table +
                                   " WHERE " + column + " IS NOT NULL AND NOT (" + column + " BETWEEN ? AND ?) LIMIT " +
                                   std::to_string(kMaxFindings));
      row.bind(min).bind(max);
      while (row.step())
        add(table, row.first_text(), column, "holds " + printable(row.text(1)) + ", allowed is " + text_of(min, max));
    });
  }

  static std::string text_of(double min, double max) {
    if (max == kAnyFinite) return exchange::number_text(min) + " or more, and finite";
    return exchange::number_text(min) + " to " + exchange::number_text(max);
  }

  void check_names(const std::string& table, const std::string& column) {
    attempt([&] {
      Statement row(database_, "SELECT " + key_of(table) + ", " + column + " FROM " + table);
      while (row.step()) {
        const std::string text = row.text(1);
        if (const std::size_t found = first_unprintable(text); found != std::string::npos)
          add(table, row.first_text(), column, "holds " + name_of_unprintable(text, found));
      }
    });
  }

  [[nodiscard]] bool is_far(const Pose2& pose) const {
    const double max_m = has_cells_ ? kMaxPlace_m : kMaxImported_m;
    const Point from = pose.position() - origin_m_;
    return !(std::abs(from.x()) <= max_m && std::abs(from.y()) <= max_m);
  }

  void check_trajectories() {
    Statement row(database_, "SELECT id, poses, trajectory FROM routes ORDER BY id");
    while (row.step())
      attempt([&] {
        const auto poses = static_cast<std::size_t>(row.integer_within(1, 0, 10'000'000));
        const std::vector<Pose2> trajectory = unpacked_trajectory(row.blob(2), poses);
        for (std::size_t i = 0; i < trajectory.size(); ++i) {
          if (!is_far(trajectory[i])) continue;
          add("routes", row.first_text(), "trajectory",
              "holds pose " + std::to_string(i + 1) + " at (" + exchange::number_text(trajectory[i].x_m) + ", " +
                  exchange::number_text(trajectory[i].y_m) + ") m, too far from the map");
          return;
        }
      });
  }

  // Every number of a shape's parameters is a length or a coordinate.
  void check_shapes() {
    Statement row(database_, "SELECT number, parameters FROM shapes ORDER BY number");
    while (row.step()) {
      const std::string parameters = row.text(1);
      for (std::string_view left = parameters; !left.empty();) {
        const std::string_view number = left.substr(0, left.find_first_of(" ,;"));
        left.remove_prefix(std::min(left.size(), number.size() + 1));
        double size_m = 0.0;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), size_m);
        if (error == std::errc{} && std::abs(size_m) <= kMaxSize_m) continue;
        add("shapes", row.first_text(), "parameters",
            "holds " + in_quotes(number) + ", allowed is " + text_of(-kMaxSize_m, kMaxSize_m));
        break;
      }
    }
  }

  void check_property(const PropertyRange& range) {
    Statement row(database_, "SELECT value FROM meta WHERE key = ?");
    row.bind_text(range.key);
    while (row.step()) {
      const std::string text = row.text(0);
      double value = std::numeric_limits<double>::quiet_NaN();
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc{} || !(value >= range.min && value <= range.max))
        add("meta", range.key, "value", "holds " + in_quotes(text) + ", allowed is " + text_of(range.min, range.max));
    }
  }

  // Within their ranges, three numbers beside the diagonal may still be those of no information.
  void check_edges() {
    Statement row(database_, "SELECT number, xx, xy, xt, yy, yt, tt FROM submap_edges ORDER BY number");
    while (row.step()) {
      const auto at = [&row](int column) { return row.real(column); };
      Eigen::Matrix3d information;
      information << at(1), at(2), at(3), at(2), at(4), at(5), at(3), at(5), at(6);
      const double largest = information.cwiseAbs().maxCoeff();
      const bool is_in_ranges =
          information.allFinite() && largest <= kMaxInformation && information.diagonal().minCoeff() >= 0.0;
      if (!is_in_ranges || largest == 0.0) continue;
      const Eigen::Matrix3d scaled = information / largest;
      constexpr double kRounding = -1e-9;
      if (Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff() <
          kRounding)
        add("submap_edges", row.first_text(), "xy",
            "is with xt and yt no information: it is not positive semidefinite");
    }
  }

  Database& database_;
  Point origin_m_{0.0, 0.0};
  bool has_cells_ = false;
  std::vector<ValueFinding> findings_;
};

}  // namespace
}  // namespace cairn::store

namespace cairn {

std::vector<ValueFinding> check_values(const std::filesystem::path& file) {
  return store::in_file(file, [&] {
    const int version = store::check_kind(file);
    try {
      store::Database database = store::Database::read_only(file);
      store::check_schema(database, version);  // a table may be a view that never ends
      return store::ValueCheck(database).run();
    } catch (const StoreError&) {
      return std::vector<ValueFinding>();
    }
  });
}

}  // namespace cairn
