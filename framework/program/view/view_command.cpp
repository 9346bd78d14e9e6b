#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/view/folder_api.hpp"
#include "framework/program/view/view_server.hpp"

namespace cairn {
namespace {

// As the page has it answered.
std::string answered(FolderApi& api, const std::string& target, const std::string& body) {
  const ViewResponse answer = api.answer({"POST", target, "", "", "", "application/json", body});
  if (answer.status != 200) throw std::runtime_error(nlohmann::json::parse(answer.body).at("error"));
  return answer.body;
}

}  // namespace

int view(const ViewCommand& command, const CommonOptions& common) {
  FolderApi api(command, common);
  const std::string token = new_view_token();
  ViewServer server(
      command.port, token, [&](const ViewRequest& request) { return api.answer(request); }, api.folder());
  const FoxgloveServices services{[&](const std::string& body) { return answered(api, "/api/plan", body); },
                                  [&](const std::string& name) { return answered(api, kSteerTarget + name, "{}"); }};
  server.offer_foxglove({played_lazily(command.map), services, command.allowed_origins});
  std::cout << fmt::format("http://127.0.0.1:{}/#t={}\n", server.port(), token)
            << fmt::format("Foxglove, Lichtblick: ws://127.0.0.1:{}/?token={}\n", server.port(), token) << std::flush;
  server.run(cancel_on_interrupt());
  return kExitDone;
}

}  // namespace cairn
