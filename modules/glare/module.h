// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/render/module.h"

namespace gloam {

[[nodiscard]] std::unique_ptr<Module> make_glare_module();

}  // namespace gloam
