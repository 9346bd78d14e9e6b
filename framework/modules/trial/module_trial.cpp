#include "framework/modules/trial/module_trial.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr std::string_view kEnd = "end";

// On one line, whatever is in it.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') out += "\\\\";
    if (c == '\n') out += "\\n";
    if (c != '\\' && c != '\n') out += c;
  }
  return out;
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_escape = text[i] == '\\' && i + 1 < text.size();
    if (is_escape) ++i;
    out += is_escape && text[i] == 'n' ? '\n' : text[i];
  }
  return out;
}

void add_line(std::string& text, std::string_view key, std::string_view value) {
  text.append(key).append(" ").append(escaped(value)).append("\n");
}

// False: there is no such line.
bool take(const std::string_view key, const std::string& value, TrialOutcome& outcome) {
  if (key == "kind") {
    const auto kind = std::ranges::find_if(kPluginKinds, [&](PluginKind known) { return name_of(known) == value; });
    if (kind == std::end(kPluginKinds)) return false;
    outcome.modules.push_back({*kind, "", ""});
    return true;
  }
  if (key == "fault") {
    outcome.fault = value;
    return true;
  }
  if (key == "fatal") {
    outcome.is_fatal = true;
    return true;
  }
  if (outcome.modules.empty() || (key != "name" && key != "summary")) return false;
  (key == "name" ? outcome.modules.back().name : outcome.modules.back().summary) = value;
  return true;
}

}  // namespace

std::string text_of(const TrialOutcome& outcome) {
  std::string text;
  if (!outcome.fault.empty()) add_line(text, "fault", outcome.fault);
  if (outcome.is_fatal) add_line(text, "fatal", "");
  for (const ModuleSummary& module : outcome.modules) {
    add_line(text, "kind", name_of(module.kind));
    add_line(text, "name", module.name);
    add_line(text, "summary", module.summary);
  }
  return text.append(kEnd).append("\n");
}

std::optional<TrialOutcome> outcome_from(std::string_view text) {
  TrialOutcome outcome;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (line == kEnd) return text.empty() ? std::optional(outcome) : std::nullopt;
    const std::size_t blank = line.find(' ');
    if (blank == std::string_view::npos || !take(line.substr(0, blank), unescaped(line.substr(blank + 1)), outcome))
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace cairn
