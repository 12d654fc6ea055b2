// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/redraw/redraw.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/render/frame/draw_frame.h"

namespace gloam {
namespace {

/// The last frame's request for this view, with the renderer's own picture as target. Usage error if the last frame did
/// not draw the view, or if its images were released since.
Result<ViewRequest> request_of_last_frame(const RendererParts& parts, const World& world, ViewId view) {
  const std::vector<ViewRequest>& all = parts.views.last_requests();
  const auto last = std::ranges::find(all, view, [](const ViewRequest& request) { return request.settings.id; });
  const ViewImages* const found = parts.views.find(view);
  if (last == all.end() || found == nullptr)
    return Error{ErrorKind::usage,
                 "view " + std::to_string(view.value) + ": what is read back must be of a view of the last frame"};
  const ViewImages& images = *found;
  GLOAM_ASSERT(images.world == parts.worlds.slot_of(world).id,
               "view " + std::to_string(view.value) + " was drawn of another world");
  ViewRequest again = *last;
  again.target = {};  // the image of a window may be gone
  again.settings.width = images.width;
  again.settings.height = images.height;
  if (images.picture_size != uvec2(images.width, images.height)) {
    again.target.width = images.picture_size.x;
    again.target.height = images.picture_size.y;
  }
  return again;
}

/// Sets the requests of the last frame back at the end of a scope: a redraw does not replace them.
class KeptRequests {
 public:
  explicit KeptRequests(ViewStore& views) : views_(views), kept_(views.last_requests()) {}
  ~KeptRequests() { views_.set_last_requests(std::move(kept_)); }
  KeptRequests(const KeptRequests&) = delete;
  KeptRequests& operator=(const KeptRequests&) = delete;

 private:
  ViewStore& views_;
  std::vector<ViewRequest> kept_;
};

}  // namespace

Result<Redrawn> redraw(RendererParts& parts, World& world, ViewId view,
                       const std::function<Status(FrameBuilder&, Captures&)>& add_copies) {
  const Result<ViewRequest> again = request_of_last_frame(parts, world, view);
  if (!again.ok()) return again.error();
  const KeptRequests kept(parts.views);
  Redrawn redrawn{nullptr, std::make_unique<Captures>(*parts.options.device)};
  const Redraw request{view, [&](FrameBuilder& builder) { return add_copies(builder, *redrawn.copies); }};
  auto frame = draw_frame(parts, world, std::span(&*again, 1), &request);
  if (!frame.ok()) return frame.error();
  redrawn.frame = std::move(*frame);
  redrawn.frame->redraw = nullptr;  // `request` ends here
  GLOAM_TRY(parts.options.device->wait_idle());
  redrawn.copies->finish();
  return redrawn;
}

}  // namespace gloam
