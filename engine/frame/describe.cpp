// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// FrameGraph::describe: the passes of a frame as text.
#include <algorithm>

#include "engine/frame/frame_graph.h"
#include "engine/frame/frame_graph_state.h"
#include "engine/gpu/access.h"
#include "engine/gpu/subresources.h"

namespace gloam {

namespace {

using frame::Declaration;
using frame::DeclaredPass;
using frame::DeclaredUse;
using frame::Plan;

std::string text_of(gpu::AccessMask mask) {
  std::string text;
  gpu::for_each_access(mask, [&](gpu::Access access) {
    if (!text.empty()) text += '|';
    text += name_of(access);
  });
  return text.empty() ? "none" : text;
}

std::string text_of_uses(const Declaration& declaration, const DeclaredPass& pass, bool writes) {
  std::string text;
  for (const DeclaredUse& use : declaration.uses_of(pass)) {
    if (use.writes != writes) continue;
    text += text.empty() ? (writes ? "; writes " : "; reads ") : ", ";
    text += declaration.resources[use.resource].name() + gpu::text_of(use.range) + " " + text_of(use.accesses);
  }
  return text;
}

std::string text_of_barriers(const Declaration& declaration, const Plan& plan, std::uint32_t first, std::uint32_t end) {
  std::string text;
  for (std::uint32_t i = first; i < end; ++i) {
    const frame::PlannedBarrier& b = plan.barriers[i];
    const bool discards = b.before == gpu::Access::none;
    text += text.empty() ? "; barriers " : ", ";
    text += declaration.resources[b.resource].name() + gpu::text_of(b.range) + " ";
    // "none" means that the contents are discarded. The barrier then waits for the earlier accesses to the memory.
    text += discards ? (b.also_before == 0 ? "none" : "none after " + text_of(b.also_before))
                     : text_of(gpu::mask_of(b.before) | b.also_before);
    text += ">" + text_of(gpu::mask_of(b.after) | b.also_after);
  }
  return text;
}

}  // namespace

std::string FrameGraph::describe() const {
  const Declaration& declaration = state_->declaration;
  const Plan* plan = state_->plan == nullptr ? nullptr : &state_->plan->plan;
  std::string text;
  for (std::uint32_t p = 0; p < declaration.passes.size(); ++p) {
    const DeclaredPass& pass = declaration.passes[p];
    text += pass.name + " [" + pass.module + "]";
    text += text_of_uses(declaration, pass, false);
    text += text_of_uses(declaration, pass, true);
    if (plan != nullptr) {
      const auto planned = std::ranges::find(plan->passes, p, &frame::PlannedPass::pass);
      if (planned == plan->passes.end()) {
        text += "; culled";
      } else {
        text += text_of_barriers(declaration, *plan, planned->first_barrier,
                                 planned->first_barrier + planned->barrier_count);
      }
    }
    text += '\n';
  }
  if (plan != nullptr && plan->first_final_barrier < plan->barriers.size()) {
    text += "end of frame" + text_of_barriers(declaration, *plan, plan->first_final_barrier,
                                              static_cast<std::uint32_t>(plan->barriers.size()));
    text += '\n';
  }
  return text;
}

}  // namespace gloam
