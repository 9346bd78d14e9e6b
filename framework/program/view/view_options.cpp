#include "framework/program/view/view_options.hpp"

#include "framework/program/view/view_request.hpp"

namespace cairn {
namespace {

std::string fault_of_origin(std::string& text) {
  if (is_page_origin(text)) return {};
  return "must be the origin of a page, as https://example.org or http://localhost:8080, without a path; found \"" +
         text + "\"";
}

}  // namespace

void add_view(CLI::App& app, CommandLine& line) {
  const auto [sub, c] =
      add_command(app, line, view, "view", "Look at a saved map or a run in a browser, and plan by clicks");
  sub->add_option("MAP", c->map, "saved map (*.cairn), or the output folder of a run")->required();
  sub->add_flag("--control", c->control, "let the page pause, resume and cancel a running mission, and give it orders");
  sub->add_flag("--edit", c->edit,
                "let the page change the saved map: names, closed routes; and write templates beside it");
  sub->add_option("--port", c->port, "of 127.0.0.1; 0: a free one")->capture_default_str();
  sub->add_option("--allow-origin", c->allowed_origins,
                  "page elsewhere whose Foxglove viewer may connect, as https://example.org (may be repeated)")
      ->allow_extra_args(false)
      ->check(CLI::Validator(fault_of_origin, "ORIGIN"));
  sub->add_option("--planner", c->planner, "planner module")->capture_default_str();
  add_number(sub, "--budget-ms", c->budget_ms, "stop planning after this time", 0.0, 1e9);
}

}  // namespace cairn
