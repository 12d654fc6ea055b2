// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/render/module.h"

namespace gloam {

/// The module "shadows": shadow maps, final lists, cookies and their reference. Needs the lights module before it.
[[nodiscard]] std::unique_ptr<Module> make_shadows_module();

}  // namespace gloam
