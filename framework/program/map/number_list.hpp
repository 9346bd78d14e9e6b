// Options that are several numbers: "x,y,deg".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cairn {

// As many finite numbers as the names, which are parted by commas ("x,y,deg"), none beyond +-most. Throws
// std::runtime_error that begins with `what`: "map crop: --box must be ...".
[[nodiscard]] std::vector<double> number_list(std::string_view text, std::string_view names, const std::string& what,
                                              double most);

}  // namespace cairn
