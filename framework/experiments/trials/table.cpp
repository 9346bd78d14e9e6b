#include "framework/experiments/trials/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/experiments/report.hpp"

namespace cairn {
namespace {

using Rows = std::vector<const ExperimentRow*>;

Rows judged_rows(const std::vector<ExperimentRow>& rows, const std::string& variant) {
  Rows judged;
  for (const ExperimentRow& row : rows)
    if (row.variant == variant && row.trial) judged.push_back(&row);
  return judged;
}

bool is_crash(const ExperimentRow& row) {
  return row.result.outcome == MissionOutcome::module_fault || row.result.outcome == MissionOutcome::sensor_fault;
}

bool is_unfaulted(const GoalVerdict& goal) {
  return goal.is_reachable && !goal.is_struck && !goal.is_displaced;
}

std::int64_t count_goals(const Rows& rows, auto is_so) {
  std::int64_t count = 0;
  for (const ExperimentRow* row : rows) count += std::ranges::count_if(row->trial->goals, is_so);
  return count;
}

struct Figure {
  const char* name;
  std::string (*text)(const TrialFigures& figures);
};

std::string whole(std::int64_t number) {
  return std::to_string(number);
}

std::string share_text(const Interval& share, std::int64_t of) {
  return fmt::format("{} of {}", text_of(share, 4), of);
}

const std::vector<Figure>& reported_figures() {
  using F = TrialFigures;
  static const std::vector<Figure> kFigures{
      {"missions", [](const F& f) { return whole(f.missions); }},
      {"driven km, simulated h",
       [](const F& f) { return fmt::format("{:.2f}, {:.2f}", 1e-3 * f.driven_m, f.time_s / 3600.0); }},
      {"done; with a step that failed or another outcome",
       [](const F& f) { return fmt::format("{}; {}", f.done, f.missions - f.done); }},
      {"without outcome or reason", [](const F& f) { return whole(f.without_outcome); }},
      {"crashes", [](const F& f) { return whole(f.faults); }},
      {"hangs", [](const F& f) { return whole(f.hangs); }},
      {"faults that struck", [](const F& f) { return whole(f.struck_by); }},
      {"contacts; fast ones that could be seen",
       [](const F& f) { return fmt::format("{}; {}", f.contacts, f.fast_contacts); }},
      {"silences while driving; ordered to stand in tick",
       [](const F& f) { return fmt::format("{}; {}", f.silences, f.worst_stop_ticks); }},
      {"goals", [](const F& f) { return whole(f.goals); }},
      {"reached, of the reachable", [](const F& f) { return share_text(f.reached, f.reachable); }},
      {"and no fault active", [](const F& f) { return share_text(f.reached_unstruck, f.unstruck); }},
      {"and not displaced by one before", [](const F& f) { return share_text(f.reached_fairly, f.unfaulted); }},
      {"and not missed for never being explored",
       [](const F& f) { return share_text(f.reached_mapped, f.unfaulted - f.unmapped); }},
      {"of these, false successes", [](const F& f) { return whole(f.false_success); }}};
  return kFigures;
}

std::string figures_text(const ExperimentConfig& config, const std::vector<TrialFigures>& all) {
  std::vector<std::string> columns{""};
  for (const ExperimentVariant& variant : config.variants) columns.push_back(variant.name);
  std::string text = table_head(columns);
  for (const Figure& figure : reported_figures()) {
    text += std::string("| ") + figure.name + " |";
    for (const TrialFigures& figures : all) text += " " + figure.text(figures) + " |";
    text += "\n";
  }
  return text;
}

std::string cell_of(std::string sentence) {
  std::ranges::replace(sentence, '|', '/');
  std::ranges::replace(sentence, '\n', ' ');
  return sentence;
}

std::string events_text(const TrialsConfig& config, const Rows& rows) {
  std::string lines;
  const auto add = [&](const ExperimentRow& row, const std::string& what, double time_s, const std::string& more) {
    lines += fmt::format("| {} | {:.1f} | {} | {} |\n", row.seed, time_s, what, cell_of(more));
  };
  for (const ExperimentRow* row : rows) {
    for (const TimedContact& touch : row->trial->fast_contacts)
      add(*row, "fast contact", touch.time_s, fmt::format("{:.3f} m/s", touch.contact.speed_mps));
    if (row->trial->hangs(config))
      add(*row, "hang", row->trial->stand.begin_s, fmt::format("stood for {:.0f} s", row->trial->stand.for_s));
    if (is_crash(*row)) add(*row, std::string(name_of(row->result.outcome)), row->result.time_s, row->result.reason);
    if (row->trial->silences.worst_stop_ticks > config.max_stop_ticks)
      add(*row, "late stop", 0.0, fmt::format("in tick {}", row->trial->silences.worst_stop_ticks));
  }
  return lines.empty() ? "" : "| seed | time s | what | |\n|---:|---:|---|---|\n" + lines + "\n";
}

std::string missed_goals_text(const Rows& rows) {
  std::string lines;
  for (const ExperimentRow* row : rows)
    for (const GoalVerdict& goal : row->trial->goals)
      if (is_unfaulted(goal) && goal.end != GoalEnd::reached)
        lines += fmt::format(
            "| {} | {} | {} | {:.0f} to {:.0f} | {} | {} | {} |\n", row->seed, goal.path, goal.goal, goal.begin_s,
            goal.end_s, name_of(goal.end), goal.is_mapped ? "" : "never explored",
            cell_of(goal.end == GoalEnd::false_success ? fmt::format("{:.2f} m too far", goal.missed_m) : goal.reason));
  return lines.empty() ? ""
                       : "Goals missed that were reachable and not faulted away:\n\n| seed | node | goal | time s | "
                         "ended | | reason |\n|---:|---|---|---|---|---|---|\n" +
                             lines + "\n";
}

}  // namespace

TrialFigures trial_figures(const TrialsConfig& config, const Rows& rows) {
  TrialFigures f;
  f.missions = std::ssize(rows);
  for (const ExperimentRow* row : rows) {
    const bool is_done = row->result.outcome == MissionOutcome::done;
    const TrialVerdict& trial = *row->trial;
    f.done += is_done ? 1 : 0;
    f.without_outcome += !is_done && row->result.reason.empty() ? 1 : 0;
    f.faults += is_crash(*row) ? 1 : 0;
    f.hangs += trial.hangs(config) ? 1 : 0;
    f.contacts += trial.contacts;
    f.fast_contacts += std::ssize(trial.fast_contacts);
    f.silences += trial.silences.silences;
    f.worst_stop_ticks = std::max(f.worst_stop_ticks, trial.silences.worst_stop_ticks);
    f.struck_by += trial.fault_count;
    f.goals += std::ssize(trial.goals);
    f.driven_m += row->result.distance_m;
    f.time_s += row->result.time_s;
  }
  const auto is_reachable = [](const GoalVerdict& g) { return g.is_reachable; };
  const auto is_unstruck = [](const GoalVerdict& g) { return g.is_reachable && !g.is_struck; };
  const auto count_reached = [&](auto of) {
    return count_goals(rows, [&](const GoalVerdict& g) { return of(g) && g.end == GoalEnd::reached; });
  };
  f.reachable = count_goals(rows, is_reachable);
  f.unstruck = count_goals(rows, is_unstruck);
  f.unfaulted = count_goals(rows, is_unfaulted);
  f.unmapped = count_goals(rows, [](const GoalVerdict& g) {
    return is_unfaulted(g) && g.end != GoalEnd::reached && g.end != GoalEnd::false_success && !g.is_mapped;
  });
  f.false_success =
      count_goals(rows, [](const GoalVerdict& g) { return is_unfaulted(g) && g.end == GoalEnd::false_success; });
  f.reached = share_of(count_reached(is_reachable), f.reachable);
  f.reached_unstruck = share_of(count_reached(is_unstruck), f.unstruck);
  f.reached_fairly = share_of(count_reached(is_unfaulted), f.unfaulted);
  f.reached_mapped = share_of(count_reached(is_unfaulted), f.unfaulted - f.unmapped);
  return f;
}

std::vector<std::string> broken_limits(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<std::string> broken;
  const TrialsConfig& trials = config.trials;
  for (const ExperimentVariant& variant : config.variants) {
    const TrialFigures f = trial_figures(trials, judged_rows(rows, variant.name));
    const auto check = [&](bool is_kept, const std::string& sentence) {
      if (!is_kept) broken.push_back(variant.name + ": " + sentence);
    };
    check(
        f.reached_fairly.value >= config.at_least_ratio || f.unfaulted == 0,
        fmt::format("{:.4f} of the goals reached, asked for are {:g}", f.reached_fairly.value, config.at_least_ratio));
    check(
        f.fast_contacts <= trials.max_fast_contacts,
        fmt::format("{} fast contacts that could be seen, allowed are {}", f.fast_contacts, trials.max_fast_contacts));
    check(f.worst_stop_ticks <= trials.max_stop_ticks,
          fmt::format("ordered to stand in tick {} without readings, allowed is {}", f.worst_stop_ticks,
                      trials.max_stop_ticks));
    check(f.hangs == 0, fmt::format("{} hangs", f.hangs));
    check(f.faults == 0, fmt::format("{} missions ended by a fault of a module or sensor", f.faults));
    check(f.without_outcome == 0, fmt::format("{} missions ended without a reason", f.without_outcome));
  }
  return broken;
}

std::vector<std::string> too_long(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<std::string> seeds;
  for (const ExperimentRow& row : rows)
    if (row.wall_s > config.trials.max_wall_s)
      seeds.push_back(fmt::format("{}: seed {} took {:.0f} s of wall clock, allowed are {:g}: a hang", row.variant,
                                  row.seed, row.wall_s, config.trials.max_wall_s));
  return seeds;
}

std::string trials_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<TrialFigures> all;
  std::string cases;
  for (const ExperimentVariant& variant : config.variants) {
    const Rows of_variant = judged_rows(rows, variant.name);
    all.push_back(trial_figures(config.trials, of_variant));
    cases += "### " + variant.name + "\n\n" + events_text(config.trials, of_variant) + missed_goals_text(of_variant);
  }
  std::string text =
      fmt::format("Seeds {} to {}; 95 % intervals.\n\n", config.seeds.from, config.seeds.from + config.seeds.count - 1);
  text += figures_text(config, all) + "\n";
  const std::vector<std::string> broken = broken_limits(config, rows);
  text += broken.empty() ? "All limits are kept.\n\n" : "Limits that are not kept:\n";
  for (const std::string& sentence : broken) text += "- " + sentence + "\n";
  return text + (broken.empty() ? "" : "\n") + cases;
}

std::string trial_times_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text = table_head({"variant", "wall s a mission, median", "longest", "tick us, median of the medians",
                                 "worst median", "median of the p99s", "worst p99"});
  for (const ExperimentVariant& variant : config.variants) {
    std::vector<double> walls_s;
    std::vector<double> medians_us;
    std::vector<double> p99s_us;
    for (const ExperimentRow* row : judged_rows(rows, variant.name)) {
      walls_s.push_back(row->wall_s);
      medians_us.push_back(row->tick.median_us);
      p99s_us.push_back(row->tick.p99_us);
    }
    if (walls_s.empty()) continue;
    text += fmt::format("| {} | {:.1f} | {:.1f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n", variant.name,
                        median_of(walls_s), *std::ranges::max_element(walls_s), median_of(medians_us),
                        *std::ranges::max_element(medians_us), median_of(p99s_us), *std::ranges::max_element(p99s_us));
  }
  for (const std::string& sentence : too_long(config, rows)) text += sentence + "\n";
  return text;
}

}  // namespace cairn
