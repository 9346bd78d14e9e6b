// Poses and relations between them as text, one a line: what SLAM benchmarks use. `#` begins a comment line.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "maps/pose_graph/relation_errors.hpp"

namespace cairn {

// `T X Y THETA` (s, m, m, rad), or the TUM form `T X Y Z QX QY QZ QW`, of which the heading about z is taken. Throws
// ExchangeError with file:line:column on anything else.
[[nodiscard]] std::vector<StampedPose> parse_stamped_poses(std::string_view text, const std::string& file_name);
// The TUM form, a line a pose, numbers as short as they can be read back.
[[nodiscard]] std::string tum_of(std::span<const StampedPose> poses);
// `T1 T2 DX DY DZ ROLL PITCH YAW`, as the Freiburg benchmark writes them: the pose at T2 in the frame of that at T1.
// Of what is not planar, DZ, ROLL and PITCH, nothing is used. Throws as above.
[[nodiscard]] std::vector<StatedRelation> parse_relations(std::string_view text, const std::string& file_name);

}  // namespace cairn
