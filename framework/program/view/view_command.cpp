#include <fmt/format.h>

#include <iostream>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/view/folder_api.hpp"
#include "framework/program/view/view_server.hpp"

namespace cairn {

int view(const ViewCommand& command, const CommonOptions& common) {
  FolderApi api(command, common);
  const std::string token = new_view_token();
  ViewServer server(
      command.port, token, [&](const ViewRequest& request) { return api.answer(request); }, api.folder());
  std::cout << fmt::format("http://127.0.0.1:{}/#t={}\n", server.port(), token) << std::flush;
  server.run(cancel_on_interrupt());
  return kExitDone;
}

}  // namespace cairn
