// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/render/kernel_check/kernel_lab.h"
#include "modules/module_list/kernel_checks.h"
#include "sandbox/selftest/checks.h"

namespace gloam {
namespace {

void add_kernel_check(KernelCheck own, std::vector<SelfTestCheck>& checks) {
  StabilityCheck check = kernel_stability(own);
  const bool quick = own.quick;
  checks.push_back(
      {std::move(check), quick, [run = std::move(own.run)](SelfTestContext& context, StabilityCheck& result) -> Status {
         const gpu::Device& device = context.lab().device();
         const std::uint64_t messages = device.validation_messages();
         const auto found = run(context.lab());
         if (!found) return found.error();
         if (device.validation_messages() != messages)
           return Error{ErrorKind::failed, "the validation layer reported a message"};
         add_case(result, found->worst, found->where);
         return {};
       }});
}

}  // namespace

void add_kernel_checks(std::vector<SelfTestCheck>& checks) {
  for (KernelCheck& own : all_kernel_checks()) add_kernel_check(std::move(own), checks);
}

}  // namespace gloam
