// The kinds of plugins. Each contract header says which kind it is: a specialisation of PluginTraits beside it.
#pragma once

#include <cstdint>
#include <string_view>

namespace cairn {

// In the order in which they were added: seeds of modules are counted by it.
enum class PluginKind {
  sensor,
  localizer,
  map,
  detector,
  planner,
  behaviour,
  path_planner,
  route_planner,
  controller,
  marker_detector,
  loop_closer
};
// In the order in which people read them.
inline constexpr PluginKind kPluginKinds[] = {
    PluginKind::sensor,        PluginKind::localizer,       PluginKind::loop_closer, PluginKind::map,
    PluginKind::detector,      PluginKind::marker_detector, PluginKind::planner,     PluginKind::path_planner,
    PluginKind::route_planner, PluginKind::controller,      PluginKind::behaviour,
};
[[nodiscard]] std::string_view name_of(PluginKind kind);

// Of an interface: `kKind`, and `Context`, what its factories get (a ModuleContext or derived from it).
template <class Interface>
struct PluginTraits;

template <class Interface>
[[nodiscard]] constexpr PluginKind kind_of() {
  return PluginTraits<Interface>::kKind;
}
template <class Interface>
using ContextOf = typename PluginTraits<Interface>::Context;

}  // namespace cairn
