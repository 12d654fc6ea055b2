// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/readback/picture.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/render/view.h"

namespace gloam {

/// The pictures of a frame, drawn or expected. Either may be absent (width 0); then it is not compared.
struct FramePictures {
  LinearPicture linear;
  Picture picture;
};

/// Cache of results that take long to compute, shared by knobs and runs. `identity`: one line that names everything
/// that a result was computed from.
class ReferenceStore {
 public:
  virtual ~ReferenceStore() = default;
  /// Empty if the result is absent, damaged or of another identity.
  [[nodiscard]] virtual std::optional<std::string> load(const std::string& identity) const = 0;
  [[nodiscard]] virtual Status save(const std::string& identity, std::string_view bytes) const = 0;
};

/// Input of a reference: one frame that was drawn and read back.
struct ReferenceInput {
  const World& world;          ///< as the frame's systems left it
  const RenderView& view;      ///< size, camera and pose of the frame
  const KnobRegistry& knobs;   ///< values with which the frame was drawn
  const FramePictures& frame;  ///< the drawn pictures; both are present
  std::uint32_t samples = 0;   ///< per pixel (and light), for references that sample; at least 1
  JobExecutor& executor;
  /// For references of light and shadow: the triangles to trace, the positions of the frame's pixels, and a function
  /// that draws the frame again. `redraw` calls `change` on the world (the same object as `world`), draws, and then
  /// calls `restore`. Null if the caller does not offer them.
  const SceneTracer* tracer = nullptr;
  const GeometryPicture* geometry = nullptr;
  std::function<Result<FramePictures>(const std::function<void(World&)>& change,
                                      const std::function<void(World&)>& restore)>
      redraw;
  const ReferenceStore* store = nullptr;  ///< null: nothing is kept
  /// Reports progress, from one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

/// Distance from the truth, over many things that move.
struct MovedDistance {
  double mean = 0.0;
  double p99 = 0.0;
};

/// Reference for a knob that is not judged by the frame at Knob::exact: a picture that the module computes on the CPU.
/// Deterministic: the same input gives the same picture with any executor.
///
/// There are two kinds. With `follows_value` false, the reference is a separate model (traced visibility, accumulated
/// lenses) that does not depend on the knob's value. It is computed once per knob, from a frame with the knob at its
/// default, and all values are compared with it. With `follows_value` true, the reference is a twin in higher precision
/// (the tone curve in double precision): the result that a value should have given from its own inputs. It is computed
/// for every value, from the frame drawn with that value.
///
/// A twin that converts the frame's linear light to the picture fills only FramePictures::picture. A traced reference
/// fills `linear`, and `picture` too if it can.
struct ReferenceInfo {
  std::string knob;            ///< a knob of the same module
  std::string kind;            ///< "traced", "accumulated" (frames drawn again) or "double precision"
  std::string name;            ///< name for the ledger: "tone curve on the CPU"
  bool follows_value = false;  ///< see above
  bool samples = false;        ///< uses ReferenceInput::samples; its noise is the change from half of them to all
  /// Knobs of the frame that a reference with `follows_value` false is computed from, and of the frames that it draws.
  std::vector<KnobOverride> drawn_with = {};
  /// Empty: pictures are judged by Knob::exact, and `distance` is set.
  std::function<Result<FramePictures>(const ReferenceInput&)> draw;
  /// An error beside that of the pictures, for each value, from its frame; none if the frame has nothing to measure.
  /// The ledger shows it as the knob's error. Empty: there is none. `frame` of the input may be absent.
  std::function<Result<std::optional<MovedDistance>>(const ReferenceInput&)> distance = {};
  std::string unit = {};  ///< of `distance`: "mm at the tip"
  /// Judges the effect's model, where `draw` has the same model as the frame: draws the frame by a method that does not
  /// share it. The ledger has the difference of each value's frame from that picture beside the value's own error,
  /// which it would hide. Samples as if `samples` were set. Not with `follows_value`. Empty: there is none.
  std::function<Result<FramePictures>(const ReferenceInput&)> draw_model = {};
  std::string model_name = {};  ///< of `draw_model`, for the ledger: "light of lamps marched along each ray"
};

}  // namespace gloam
