// Names that graph files give to landmarks.
#pragma once

#include <string_view>

#include "maps/base/source_text.hpp"

namespace cairn::exchange {

// Fails where the name (or what else it is) stands when it holds a control character.
void check_name(const SourceText& source, std::size_t offset, std::string_view what, std::string_view name);

}  // namespace cairn::exchange
