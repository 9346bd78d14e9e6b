#include "maps/exchange/graphs/imported_names.hpp"

#include <string>

#include "maps/base/printable.hpp"
#include "maps/base/spelling.hpp"

namespace cairn::exchange {

void check_name(const SourceText& source, std::size_t offset, std::string_view what, std::string_view name) {
  if (first_unprintable(name) != std::string_view::npos)
    source.fail(offset, "the " + std::string(what) + " " + in_quotes(name) + " holds a control character");
}

}  // namespace cairn::exchange
