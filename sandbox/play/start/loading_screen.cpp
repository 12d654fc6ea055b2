// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/start/loading_screen.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sandbox/session/session.h"

namespace gloam {
namespace {

constexpr float kLoadingBarWidth = 420.0f;
constexpr float kLoadingBarHeight = 18.0f;
constexpr float kLoadingTurn = 0.07f;  // of the bar, per frame
constexpr std::array<float, 4> kBackground = {0.05f, 0.055f, 0.07f, 1.0f};

void add_clear_pass(FrameGraph& graph, ImageRef& picture) {
  const gpu::ImageDesc desc = graph.desc(picture);
  PassBuilder pass = graph.add_pass("loading", "panel");
  picture = pass.write(picture, gpu::Access::color_target);
  pass.execute([picture, width = desc.width, height = desc.height](PassContext& context) {
    context.commands().begin_rendering(
        {.colors = {{.view = {.image = context.image(picture)}, .load = gpu::LoadOp::clear, .clear = kBackground}},
         .width = width,
         .height = height});
    context.commands().end_rendering();
  });
}

}  // namespace

LoadingScreen::LoadingScreen(std::unique_ptr<gpu::Device> device, std::unique_ptr<gpu::Swapchain> swapchain,
                             Window& window)
    : device_(std::move(device)),
      swapchain_(std::move(swapchain)),
      pictures_(window, *swapchain_),
      gui_(window.content_scale()),
      graph_(*device_) {}

Result<std::unique_ptr<LoadingScreen>> LoadingScreen::open(Window& window, const Options& options, LogSink& log) {
  Options own = options;
  own.cache_dir.clear();  // the scene's device writes that file
  auto device =
      open_device(own, log, {.extensions = window.vulkan_extensions(), .create_surface = window.surface_maker()});
  if (!device) return device.error();
  auto swapchain = gpu::create_swapchain(**device, window.surface_maker());
  if (!swapchain) return swapchain.error();
  return std::unique_ptr<LoadingScreen>(
      new LoadingScreen(std::move(device).value(), std::move(swapchain).value(), window));
}

void LoadingScreen::lay_out(const LoadingStep& step) {
  const auto width = static_cast<float>(pictures_.width());
  const auto height = static_cast<float>(pictures_.height());
  gui_.begin({}, {.width = pictures_.width(), .height = pictures_.height(), .dt_s = 0.03});
  const float bar = std::min(kLoadingBarWidth * gui_.scale(), 0.8f * width);
  ImGui::SetNextWindowPos(ImVec2(0.5f * (width - bar), 0.45f * height));
  ImGui::SetNextWindowSize(
      ImVec2(bar, 4.0f * kLoadingBarHeight * gui_.scale()));  // of a fixed size: shown from frame 1 on
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0f, 0.0f));
  if (ImGui::Begin("loading", nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoInputs)) {
    ImGui::TextUnformatted(step.what.c_str());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float tall = kLoadingBarHeight * gui_.scale();
    turn_ = std::fmod(turn_ + kLoadingTurn, 1.0f);
    const float share = step.total == 0 ? 0.2f : static_cast<float>(step.done) / static_cast<float>(step.total);
    const float from = step.total == 0 ? turn_ * 1.2f - 0.2f : 0.0f;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, ImVec2(at.x + bar, at.y + tall), ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
    list->AddRectFilled(ImVec2(at.x + std::max(from, 0.0f) * bar, at.y),
                        ImVec2(at.x + std::clamp(from + share, 0.0f, 1.0f) * bar, at.y + tall),
                        ImGui::GetColorU32(ImGuiCol_PlotHistogram), 3.0f);
    ImGui::Dummy(ImVec2(bar, tall));
    if (step.total > 0) ImGui::Text("%zu of %zu", step.done, step.total);
  }
  ImGui::End();
  ImGui::PopStyleVar();
  gui_.end();
}

Status LoadingScreen::declare(bool& shown) {
  const auto image = pictures_.acquire();
  if (!image.ok()) return image.error();
  shown = static_cast<bool>(*image);
  graph_.begin();
  if (shown) {
    ImageRef picture = graph_.import_image("window", *image, gpu::Access::none, gpu::Access::present);
    add_clear_pass(graph_, picture);
    GLOAM_TRY(renderer_->add_pass(graph_, picture, gui_.draw_data()));
  }
  return graph_.compile();
}

Status LoadingScreen::show(const LoadingStep& step) {
  const auto visible = pictures_.follow_window();
  if (!visible.ok()) return visible.error();
  if (!*visible) return {};
  if (renderer_ == nullptr) {
    auto renderer = PanelRenderer::create(*device_, gui_.font());
    if (!renderer.ok()) return renderer.error();
    renderer_ = std::move(renderer).value();
  }
  lay_out(step);
  auto commands = device_->begin_frame();
  if (!commands.ok()) return commands.error();
  bool shown = false;
  if (const Status declared = declare(shown); !declared.ok()) {
    static_cast<void>(device_->abandon_frame());
    return declared;
  }
  graph_.execute(**commands);
  GLOAM_TRY(device_->submit_frame());
  const auto presented = pictures_.present();
  return presented.ok() ? Status() : Status(presented.error());
}

}  // namespace gloam
