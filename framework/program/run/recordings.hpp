// The recordings of `cairn run`: under which names, and how each ends.
#pragma once

#include "framework/mission/runner.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/reporting/recordings/mcap_recording.hpp"
#include "framework/reporting/recordings/recording.hpp"

namespace cairn {

// What a real robot has seen cannot be seen again: it is recorded unless the mission says otherwise. Neither that nor
// what an earlier run of a resumed mission has recorded is replaced.
void choose_recordings(MissionConfig& config, const RunCommand& command, bool is_real);

// What cannot be written is reported, and the run ends as it would have.
void finish(RunRecording& recording);
// With the mission's file, its report and its map. What is missing of them leaves a recording that is whole.
void finish(McapRecording& recording, const RunCommand& command, const MissionResult& result,
            const OccupancyGrid* grid);

}  // namespace cairn
