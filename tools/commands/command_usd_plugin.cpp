// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "tools/program/command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace anicodec::tools {
namespace {

constexpr const char* kUsdPluginFooter =
    R"(install writes a file beside usd-core that names the plug-in, so that every program of this Python
has it without an import; remove takes that file away; path prints the folder of the plug-in, for
PXR_PLUGINPATH_NAME. `import anicodec.usd` before the first stage is opened does the same for one
process. The plug-in is a part of the Python package, and so is this command:
pip install 'anicodec[usd]'.

Examples:
  anicodec usd-plugin install
  PXR_PLUGINPATH_NAME=$(anicodec usd-plugin path) python3 render.py)";

const std::vector<std::string> kActions = {"install", "remove", "path"};

void run(const std::string& action) {
  if (std::find(kActions.begin(), kActions.end(), action) == kActions.end())
    throw Error(ErrorKind::kUsage,
                "usd-plugin: '" + action + "' is none of install, remove and path");
  throw Error(ErrorKind::kUnsupported,
              "usd-plugin is a command of the Python package: pip install 'anicodec[usd]'");
}

}  // namespace

void add_usd_plugin(Commands& commands, CommonOptions& common) {
  auto action = std::make_shared<std::string>();
  Options& options = add_command(
      commands, common, kJson,
      {"usd-plugin", "install|remove|path", "Make .anic files layers of OpenUSD", kUsdPluginFooter},
      [action] { run(*action); });
  options.argument("ACTION", *action, "install, remove or path").required().words = kActions;
}

}  // namespace anicodec::tools
