#include "plugins/table_log/config.hpp"

namespace cairn {

void TableLogConfig::describe(Fields<TableLogConfig>& fields) {
  TableConfig::describe_table(fields);
  fields.numbers("range_columns", &TableLogConfig::range_columns, {1, 10000}, "",
                 "columns of the ranges, from 1, in the order of the sonars");
  fields.integer("first_range_column", &TableLogConfig::first_range_column, {0, 10000},
                 "instead of range_columns: the first of consecutive columns, one a sonar");
  fields.choice("range_unit", &TableLogConfig::range_unit,
                {{"m", LengthUnit::metres}, {"cm", LengthUnit::centimetres}, {"mm", LengthUnit::millimetres}},
                "of the ranges");
  fields.numbers("no_echo", &TableLogConfig::no_echo, {}, "", "values, as they stand in the table, that mean no echo");
  fields.list("sonars", &TableLogConfig::sonars, "where the ranges were taken; without it, the robot's sonars");
  fields.number("period_s", &TableLogConfig::period_s, {1e-6, 3600}, "s", "time between rows without time_column");
  fields.group("poses", &TableLogConfig::poses, "a second table with the poses, joined by time");
  fields.choice("join", &TableLogConfig::join, {{"equal", PoseJoin::equal}, {"not_later", PoseJoin::not_later}},
                "which pose belongs to a row: that of the same time, or the last one not later");
  fields.flag("compass_from_pose", &TableLogConfig::compass_from_pose, "the pose's heading also serves as a compass");
  fields.choice("on_bad_line", static_cast<BadLine TableLogConfig::*>(&TableLogConfig::on_bad_line),
                {{"refuse", BadLine::refuse}, {"skip", BadLine::skip}},
                "a line that cannot be read: an error, or left out and counted");
}

}  // namespace cairn
