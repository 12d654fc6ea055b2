// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/commands.h"
#include "sandbox/session/scene_loading.h"

namespace gloam {

Status run_bake(const CommandContext& context) {
  GLOAM_TRY(check_scene_exists(context.options.scene));
  return Error{ErrorKind::failed, "bake is not built yet: this version captures no proxies and probes"};
}

}  // namespace gloam
