// The page of the view, compiled into the program (page/).
#pragma once

#include <optional>
#include <string>

#include "framework/program/view/view_request.hpp"

namespace cairn {

// None: the page has no such file.
[[nodiscard]] std::optional<ViewResponse> page_file(const std::string& target);

}  // namespace cairn
