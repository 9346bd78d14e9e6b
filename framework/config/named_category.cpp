#include "framework/config/named_category.hpp"

#include <algorithm>

#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr std::string_view kNearest = "nearest ";

}  // namespace

bool names_nothing(std::string_view text) {
  return text.empty() || text == kNearest || text == kNearest.substr(0, kNearest.size() - 1);
}

void check_category_is_known(const std::string& category, const SourcePlace& place, const std::string& what,
                             const std::vector<std::string>& categories) {
  const bool is_known = categories.empty() || std::ranges::find(categories, category) != categories.end();
  if (is_known && !category.empty()) return;
  throw ConfigError(place, what + ": the mission has no template of category " + in_quotes(category) +
                               did_you_mean(category, categories) +
                               (categories.empty() ? "" : "; it has " + joined(categories)));
}

void check_named_categories(const ConfigValue& value, const std::string& what,
                            const std::vector<std::string>& categories) {
  if (value.kind == ConfigValue::Kind::scalar && value.scalar.starts_with(kNearest))
    check_category_is_known(value.scalar.substr(kNearest.size()), value.place, what, categories);
  for (const ConfigValue& item : value.items) check_named_categories(item, what, categories);
}

}  // namespace cairn
