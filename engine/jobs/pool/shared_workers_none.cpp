// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/system/process.h"
#include "engine/jobs/pool/shared_workers.h"

// For builds without oneTBB.

namespace gloam {

std::unique_ptr<SharedWorkers> SharedWorkers::create(std::uint32_t) { return nullptr; }

bool SharedWorkers::exist() { return false; }

std::uint32_t SharedWorkers::core_count() { return usable_cores(); }

}  // namespace gloam
