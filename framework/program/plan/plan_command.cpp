#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <thread>

#include "framework/config/config_value.hpp"
#include "framework/live/line_socket.hpp"
#include "framework/planning/saved_map/map_planner.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/plan/answer_line.hpp"
#include "framework/program/plan/line_reader.hpp"
#include "framework/program/plan/plan_query.hpp"
#include "framework/program/plan/plan_server.hpp"
#include "maps/base/ordered_parallel_map.hpp"
#include "maps/pictures/saved_map_picture.hpp"

namespace cairn {
namespace {

std::string text_for_people(const PlanQuery& query, const PlanResult& result, const MapPlanner& planner) {
  std::string text = text_of(query, result, planner.map(), clusters_for(planner, result));
  if (const auto trajectory = trajectory_for(planner, query, result); !trajectory.empty())
    text += fmt::format("  driven in {:.1f} s\n", trajectory.back().time_s);
  return text;
}

struct QueryAnswer {
  std::string text;
  bool is_solved = false;
};

QueryAnswer answer_to(const PlanQuery& query, const MapPlanner& planner, const CommonOptions& common) {
  const PlanResult result = planner.answer(query.question);
  return {common.json ? json_line_of(query, result, planner) : text_for_people(query, result, planner),
          result.outcome == PlanOutcome::solved};
}

std::size_t jobs_of(const PlanCommand& command) {
  return command.jobs ? static_cast<std::size_t>(*command.jobs) : std::max(1U, std::thread::hardware_concurrency());
}

PlanQuery query_of_one_map(const std::string& line, const std::string& file, int number, const PlanQuestion& defaults) {
  PlanQuery query = query_of_line(line, file, number, defaults);
  if (!query.map.empty())
    throw ConfigError({file, number, 1}, "\"map\" is for `cairn plan --serve`: here the command names the map");
  return query;
}

int answer_queries(const MapPlanner& planner, const PlanCommand& command, const CommonOptions& common) {
  LineReader lines(command.queries);
  const auto take = [&]() -> std::optional<PlanQuery> {
    std::string line;
    while (lines.next(line))
      if (line.find_first_not_of(" \t\r") != std::string::npos)
        return query_of_one_map(line, command.queries, lines.number(), command.question);
    return std::nullopt;
  };
  bool has_any = false;
  bool all_solved = true;
  const auto give = [&](const QueryAnswer& answer, bool more_follow) {
    has_any = true;
    all_solved = all_solved && answer.is_solved;
    std::cout << answer.text;
    if (!more_follow) std::cout.flush();
    if (!std::cout) throw std::runtime_error("plan: the answers cannot be written to standard output");
  };
  ordered_parallel_map(
      jobs_of(command), take, [&](const PlanQuery& query) { return answer_to(query, planner, common); }, give,
      [&] { lines.stop(); });
  if (!has_any) throw ConfigError({command.queries, 0, 0}, "holds no query");
  return all_solved ? kExitDone : kExitNotSolved;
}

void draw(const MapPlanner& planner, const PlanCommand& command, const PlanQuery& query, const PlanResult& result) {
  MapPicture picture = picture_of(planner.map());
  picture.driven.clear();
  for (const Pose2& pose : result.path) picture.planned.push_back(pose.position());
  picture.planned_landmarks = result.landmarks;
  if (!result.path.empty()) {
    picture.start = result.path.front().position();
    picture.goal = result.path.back().position();
  }
  picture.robot_path = result.path;
  picture.robot_radius_m = planner.radius_m();
  picture.robot_polygon_m = planner.robot().polygon_m;
  picture.title = fmt::format("{} to {}: {}", query.question.from, query.question.to, name_of(result.outcome));
  if (result.outcome == PlanOutcome::solved) picture.title += fmt::format(", {:.2f} m", result.length_m);
  write_map_picture(command.picture, picture);
}

PlannerUse use_of(const PlanCommand& command) {
  if (!command.queries.empty()) return command.jobs == 1 ? PlannerUse::many_in_turn : PlannerUse::many_at_once;
  return command.picture.empty() ? PlannerUse::one_question : PlannerUse::one_question_whole_grid;
}

void check_served(const PlanCommand& command) {
  const PlanQuestion& question = command.question;
  if (!question.from.empty() || !question.to.empty() || !command.queries.empty() || !command.picture.empty())
    throw std::runtime_error(
        "plan: --serve takes its questions, and gives its answers, over the socket; --from, --to, "
        "--queries and --picture are for questions asked here");
}

int serve(const PlanCommand& command, const CommonOptions& common) {
  const std::atomic<bool>& end = cancel_on_interrupt();
  const live::Address address = live::address_of(command.serve);
  const ModuleLibrary library = module_library(common);
  ServedMaps maps(command, library);
  PlanServer server(maps, address, jobs_of(command), command.question);
  std::cout << "plans on " << command.map.string() << " are answered at " << live::text_of(address) << "\n"
            << std::flush;
  server.run(end);
  return kExitDone;
}

void check(const PlanCommand& command) {
  if (!command.serve.empty()) return check_served(command);
  const PlanQuestion& question = command.question;
  if (command.queries.empty()) {
    if (question.from.empty() || question.to.empty())
      throw std::runtime_error("plan: give --from PLACE and --to PLACE, or --queries FILE");
    if (command.jobs) throw std::runtime_error("plan: --jobs is for many questions; give it with --queries");
    check(question);
    return;
  }
  if (!question.from.empty() || !question.to.empty())
    throw std::runtime_error(std::string("plan: --") + (question.from.empty() ? "to" : "from") +
                             " is for one question; with --queries every line has its own");
  if (!command.picture.empty())
    throw std::runtime_error("plan: --picture draws one route; give it with --from and --to");
}

}  // namespace

int plan(const PlanCommand& command, const CommonOptions& common) {
  check(command);
  if (!command.serve.empty()) return serve(command, common);
  const ModuleLibrary library = module_library(common);
  const MapPlanner planner(command, use_of(command), library);
  if (!command.queries.empty()) return answer_queries(planner, command, common);
  const PlanQuery query{"", "", command.question};
  const PlanResult result = planner.answer(query.question);
  if (common.json) std::cout << json_line_of(query, result, planner);
  (common.json ? std::cerr : std::cout) << text_for_people(query, result, planner);
  if (!command.picture.empty()) draw(planner, command, query, result);
  return result.outcome == PlanOutcome::solved ? kExitDone : kExitNotSolved;
}

}  // namespace cairn
