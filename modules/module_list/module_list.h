// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/module.h"

namespace gloam {

/// Every module of this build, in the order of the module graph. Modules that are not implemented yet provide only
/// their components and keys.
[[nodiscard]] ModuleList make_all_modules();

}  // namespace gloam
