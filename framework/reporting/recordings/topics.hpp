// Names of what a run publishes, the same in its recording and in Foxglove's viewers while it runs.
#pragma once

namespace cairn::topics {

inline constexpr const char* kPose = "/pose";
inline constexpr const char* kTransform = "/transform";
inline constexpr const char* kTruth = "/truth";
inline constexpr const char* kMap = "/map";
inline constexpr const char* kLandmarks = "/landmarks";
inline constexpr const char* kPlan = "/plan";
inline constexpr const char* kTree = "/tree";
inline constexpr const char* kLog = "/log";

// Of recordings only.
inline constexpr const char* kRanges = "/ranges";
inline constexpr const char* kScan = "/scan";
inline constexpr const char* kPlanResult = "/plan_result";

// Of views only.
inline constexpr const char* kDrivenPath = "/driven_path";
inline constexpr const char* kWatchedRanges = "/ranges_in_map";  // another content than /ranges
inline constexpr const char* kStatus = "/status";

}  // namespace cairn::topics
