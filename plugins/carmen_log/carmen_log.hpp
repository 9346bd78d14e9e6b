// A CARMEN log played back. Plugin `carmen_log`, kind sensor; nothing to drive.
//
// Each line with ranges is one observation: FLASER, RLASER, ROBOTLASER1 and 2 (with and without
// remissions), LASER_READING (GMapping's logs), L (with its odometry O, in cm), SONAR; and RAWLASER1 and 2 where no
// other laser lines are. ODOM, TRUEPOS and the laser lines say where the robot is; SONAR and RAWLASER, which do not,
// get the pose of the last line before them that does, or else of the first. PARAM gives laser offsets and maximum
// ranges. Logs that hold a pose graph (EDGE2 of TORO, EDGE_SE2 of g2o, a VERTEX2 or VERTEX_SE2 before each scan) give
// as odometry the edges from each scan's vertex to the next one's; the vertices' poses, which are corrected, are not
// read. Comments (#) and SYNC say nothing, all other kinds are counted. What a recording of `record:` holds beyond
// CARMEN (docs/logs.md) is read to the last bit.
//
// Bad lines, refused at their file:line:column or skipped and counted: a number that is none, a count
// that does not fit the line, a pose beyond 100 km, more than 1 MiB in a line,
// compressed data that is cut off or damaged.
#pragma once

#include "framework/contracts/sensor.hpp"
#include "plugins/carmen_log/config.hpp"

namespace cairn::carmen_log {

// Reads the whole log. Throws ConfigError for what is refused and for a log without an observation.
[[nodiscard]] log_common::ScanLog read_carmen_log(const Config& config, const Budget& budget = {});

}  // namespace cairn::carmen_log
