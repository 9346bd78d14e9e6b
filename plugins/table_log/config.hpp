// Settings of the table log: where the tables are and what their columns mean.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "plugins/common/logs/scan_log.hpp"

namespace cairn {

enum class Separator { whitespace, comma, semicolon, tab };
enum class TimeUnit { seconds, milliseconds };
enum class LengthUnit { metres, centimetres, millimetres };
enum class AngleUnit { degrees, radians, decidegrees };
enum class PoseJoin { equal, not_later };
using log_common::BadLine;

// One file of columns. Columns count from 1; 0: the table has no such column.
struct TableConfig {
  std::filesystem::path file;
  Separator separator = Separator::whitespace;
  int skip_lines = 0;
  std::string comment = "#";
  int time_column = 0;
  int x_column = 0;
  int y_column = 0;
  int heading_column = 0;
  TimeUnit time_unit = TimeUnit::seconds;
  LengthUnit length_unit = LengthUnit::metres;
  AngleUnit angle_unit = AngleUnit::degrees;

  // The same fields for a config that is a table and more.
  template <class Config>
  static void describe_table(Fields<Config>& fields) {
    fields.file("file", &Config::file, "the table").required = true;
    fields.choice("separator", static_cast<Separator Config::*>(&Config::separator),
                  {{"whitespace", Separator::whitespace},
                   {"comma", Separator::comma},
                   {"semicolon", Separator::semicolon},
                   {"tab", Separator::tab}},
                  "what stands between two columns");
    fields.integer("skip_lines", static_cast<int Config::*>(&Config::skip_lines), {0, 1e6},
                   "lines at the head that are no data");
    fields.text("comment", &Config::comment, "lines that begin with this are no data; empty: none do");
    const auto column = [&fields](const char* key, int TableConfig::*member, const char* meaning) {
      fields.integer(key, static_cast<int Config::*>(member), {0, 10000}, meaning);
    };
    column("time_column", &TableConfig::time_column, "column of the time, from 1; 0: none");
    column("x_column", &TableConfig::x_column, "column of the robot's x; 0: none");
    column("y_column", &TableConfig::y_column, "column of the robot's y; 0: none");
    column("heading_column", &TableConfig::heading_column, "column of the robot's heading, anticlockwise; 0: none");
    fields.choice("time_unit", static_cast<TimeUnit Config::*>(&Config::time_unit),
                  {{"s", TimeUnit::seconds}, {"ms", TimeUnit::milliseconds}}, "of the time column");
    fields.choice("length_unit", static_cast<LengthUnit Config::*>(&Config::length_unit),
                  {{"m", LengthUnit::metres}, {"cm", LengthUnit::centimetres}, {"mm", LengthUnit::millimetres}},
                  "of x and y");
    fields.choice("angle_unit", static_cast<AngleUnit Config::*>(&Config::angle_unit),
                  {{"deg", AngleUnit::degrees}, {"rad", AngleUnit::radians}, {"decideg", AngleUnit::decidegrees}},
                  "of the heading");
  }
  static void describe(Fields<TableConfig>& fields) { describe_table(fields); }
};

struct LogSonar {
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_rad = 0.0;
  double half_beam_rad = radians(15.0);
  double min_m = 0.1;
  double max_m = 5.0;

  static void describe(Fields<LogSonar>& fields) {
    fields.number("x_m", &LogSonar::x_m, {-10, 10}, "m", "ahead of the robot's centre");
    fields.number("y_m", &LogSonar::y_m, {-10, 10}, "m", "to the left of the robot's centre");
    fields.angle("angle_deg", &LogSonar::angle_rad, {-360, 360}, "of its axis, anticlockwise from ahead").required =
        true;
    fields.angle("half_beam_deg", &LogSonar::half_beam_rad, {0, 90}, "0: a ray");
    fields.number("min_m", &LogSonar::min_m, {0, 100}, "m",
                  "shortest range; a nearer reading, a negative one and NaN say nothing to any map");
    fields.number("max_m", &LogSonar::max_m, {0.01, 1000}, "m",
                  "longest range; a reading this far or farther means no echo up to here");
  }
};

struct TableLogConfig : TableConfig, log_common::LogRules {
  std::vector<double> range_columns;
  int first_range_column = 0;
  LengthUnit range_unit = LengthUnit::metres;
  std::vector<LogSonar> sonars;
  std::optional<TableConfig> poses;
  PoseJoin join = PoseJoin::equal;

  static void describe(Fields<TableLogConfig>& fields);
};

}  // namespace cairn
