#include "plugins/behaviours/errands/file_name.hpp"

#include "framework/config/fields.hpp"
#include "maps/base/spelling.hpp"

namespace cairn::behaviours {

std::string file_name_of(const ConfigValue& value, const std::string& usual, const std::string& ending) {
  if (value.kind == ConfigValue::Kind::null) return usual;
  std::string name = config_detail::to_file_name(value, "file");
  if (!name.ends_with(ending) || name == ending)
    throw ConfigError(value.place, "file must end in " + ending + ", found " + in_quotes(name));
  if (name.ends_with(".autosave.cairn"))
    throw ConfigError(value.place,
                      "file: " + in_quotes(name) + " is a name of autosaves; they are taken away at the end");
  return name;
}

}  // namespace cairn::behaviours
