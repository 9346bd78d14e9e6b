// Two rooms of 4 x 4 m of Enki with a door of 1 m, a circle and a square in the first, a square in the second, and in
// it the body of a Pioneer 3-DX. Programs that are linked with it are linked with Enki, and so are under the GNU
// General Public License, version 2 or later; with Fast DDS (Apache License 2.0) version 3.
#pragma once

#include <filesystem>
#include <memory>

#include "tests/plugins/p2os_robot/pioneer_body.hpp"

namespace cairn::enki {

// log gets a line a tenth of a second: monotonic_s,x_m,y_m,angle_deg,v_mps,touches
[[nodiscard]] std::unique_ptr<p2os_robot::PioneerBody> pioneer_in_two_rooms(const std::filesystem::path& log);

}  // namespace cairn::enki
