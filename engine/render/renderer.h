// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "engine/render/frame_report.h"
#include "engine/render/governor/frame_budget.h"
#include "engine/render/readback/picture.h"
#include "engine/render/renderer_options.h"
#include "engine/render/view_request.h"

namespace gloam {

class World;
struct GeometryPicture;
struct RendererParts;

/// Draws worlds. Owns modules, knobs, the schedule and all GPU state. Use it from one thread at a time.
class Renderer {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Renderer>> create(RendererOptions options);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  [[nodiscard]] KnobRegistry& knobs();
  [[nodiscard]] const ModuleList& modules() const;
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const;
  /// Whether a visualizer can be shown: its name, its argument and the knob that it needs. Usage error if not; for an
  /// unknown name it lists the valid ones.
  [[nodiscard]] Status check_visualizer(const World& world, std::string_view name) const;

  /// From now on the renderer chooses among measured settings so that whole frames, or the passes of one effect, stay
  /// within a time: after each frame that add_frame_time() tells of, it may set the knobs that the front's points name
  /// to another point. Replaces an earlier budget of the same effect. Usage error if the time is not above 0, if a
  /// setting, a locked knob or the effect does not exist, or if another budget sets one of the knobs; then nothing
  /// changes. With Readiness::background, a change waits until its pipelines are ready.
  [[nodiscard]] Status set_budget(FrameBudget budget);
  /// Changes the time and the locked knobs of an effect's budget (empty: that of whole frames). Front, point in use and
  /// what the frames so far have shown stay. Knobs that are no longer locked get the values of the point in use. Usage
  /// error without such a budget, and as of set_budget(); then nothing changes.
  [[nodiscard]] Status change_budget(std::string_view effect, double ms, std::vector<std::string> locked);
  /// Ends the budget of an effect; empty: that of whole frames. The knobs keep the values that they have.
  void clear_budget(std::string_view effect = {});
  /// How long the last frame, or an effect in it, took, for the budget of the same effect; call it once a frame for
  /// each budget. Returns what was decided; nothing without such a budget. Frames that were drawn before a change has
  /// taken effect, the first after it, and those while pipelines are made in the background are not judged. The
  /// pipelines of the points beside a new one are made there.
  std::optional<GovernorDecision> add_frame_time(const FrameTime& time);
  /// None without such a budget.
  [[nodiscard]] std::optional<BudgetState> budget(std::string_view effect = {}) const;
  /// Of all budgets, in the order in which they were first set.
  [[nodiscard]] std::vector<BudgetState> budgets() const;

  /// Registers the components and resources of the scene and of every module. What the world already holds stays as it
  /// is. A world that is prepared again is released. One renderer at a time draws a world: the one that has prepared
  /// it, and after its end one with the same modules.
  void prepare_world(World& world) const;
  /// Frees the GPU data of a world, its history, the images of the views that it drew last, and the memory of modules
  /// that no view of another world has needed. Call it before the world is destroyed; a world that is destroyed without
  /// it is released in the next frame. If the world is drawn again, its data is uploaded again.
  /// This and the next functions wait for the GPU, and the memory is free when they return. They must not be called
  /// while a frame is being drawn.
  void release_world(const World& world);
  /// Frees all that the renderer and the modules keep for a view: images, its picture included, maps, histories and
  /// results; and all memory of modules that no other view has needed. Drawing the view again creates it again. The
  /// images of a view that is not drawn for a while are freed without this call. An unknown view has nothing to free.
  void release_view(ViewId view);
  /// The same, and removes the view's resources from the world.
  void release_view(World& world, ViewId view);

  /// Draws one frame: runs the world systems, then the systems and passes of each view, and submits. Does not wait for
  /// the GPU. On an error the frame is given up: the GPU executes nothing of it, its system commands are dropped, and
  /// the next call draws as if it had not been begun. Exceptions of systems, jobs and passes become errors that name
  /// the system or the pass, if they are derived from std::exception; others pass through after the frame was given up.
  /// A view of more than kMostViewPixels a side is a usage error.
  [[nodiscard]] Status render(World& world, std::span<const ViewRequest> views);
  /// Replaces RendererOptions::readiness from the next frame on: tools show a whole first frame, and then wait for
  /// nothing. Uploads of changed assets stay as they were created.
  void set_readiness(Readiness readiness);
  /// Whether a module that the last frame's world demanded changes the picture of this world while nothing else does
  /// (Module::changes_at_rest). False before the first frame. Animations of the scene are not asked about.
  [[nodiscard]] bool changes_at_rest(const World& world) const;
  /// How many frames of a view of this world at rest it takes until its picture is complete (Module::frames_to_rest),
  /// of the same modules.
  [[nodiscard]] std::uint32_t frames_to_rest(const World& world) const;
  /// Waits until the GPU has finished everything submitted.
  [[nodiscard]] Status wait();

  [[nodiscard]] FrameReport report();
  /// The GPU times of every frame that has completed since the last call, oldest first; at most the last 4. For callers
  /// that keep several frames in flight.
  [[nodiscard]] std::vector<GpuFrameTimes> take_times();
  /// Waits for the GPU, then frees the memory of cached plans except the last frame's (FrameGraph::free_idle_memory),
  /// of staging, and of all objects that were destroyed before; gives empty memory blocks back to the driver
  /// (gpu::Device::free_idle_memory); and has modules free what only past frames have needed: an atlas of shadow maps
  /// that is too large shrinks in the next frame. Pipelines that were in no frame for 600 frames are destroyed. Without
  /// this call, memory of unused plans is kept for a while, in case frames with the same passes return.
  void free_idle_memory();
  /// Reads the picture of a view's last frame. Waits for the GPU. Usage error if the view has no picture: it was not
  /// drawn, or into a target image, or its images were released; that holds for the images of all functions below.
  /// Fails if all frames that drew the view since its images were made were given up.
  [[nodiscard]] Result<Picture> read_picture(ViewId view);
  /// Reads the linear light of the view's last frame, after all passes. Asserts that the frame has kept it
  /// (ViewRequest::keep_linear). Waits for the GPU.
  [[nodiscard]] Result<LinearPicture> read_linear(ViewId view);
  /// Reads an image that passes of the view's last frame exposed (FrameBuilder::expose). Draws that frame again and
  /// waits for the GPU. The engine exposes "base_color", "normals", "material" and "depth". For an unknown name, a
  /// usage error lists the exposed images.
  [[nodiscard]] Result<ImageBytes> read_image(World& world, ViewId view, std::string_view name);
  /// Reads several images of the same frame, in the order of the names. The names must differ.
  [[nodiscard]] Result<std::vector<ImageBytes>> read_images(World& world, ViewId view,
                                                            std::span<const std::string_view> names);
  /// Reads the geometry buffer of the view's last frame. Draws that frame again and waits for the GPU.
  [[nodiscard]] Result<GeometryPicture> read_geometry(World& world, ViewId view);
  /// Facts that the engine and the modules know about a pixel of the last frame, as lines of text. Draws that frame
  /// again and waits for the GPU. Usage error if the pixel lies outside the picture.
  [[nodiscard]] Result<std::vector<std::string>> pick(World& world, ViewId view, std::uint32_t x, std::uint32_t y);
  /// World position of the surface that a pixel of the view's last frame shows; none for the sky. Draws that frame
  /// again and waits for the GPU. Usage error if the pixel lies outside the picture.
  [[nodiscard]] Result<std::optional<dvec3>> pick_position(World& world, ViewId view, std::uint32_t x, std::uint32_t y);
  /// Replaces a shader in all pipelines from the next frame on, for tools that compile shaders while they run. Usage
  /// error if the words are no SPIR-V, or if passes that were written for the embedded shader cannot use them
  /// (gpu::interface_difference); then nothing changes.
  [[nodiscard]] Status replace_shader(const gpu::ShaderCode& embedded, std::vector<std::uint32_t> words);
  /// All existing pipelines that frames have asked for, as text for make_pipelines() of a later process.
  [[nodiscard]] std::string pipeline_record() const;
  /// Has the pipelines of a record made in the background, for example while a scene is loaded, so that the first frame
  /// finds them. shaders: those that pipelines may have; they must outlive the renderer. Pipelines of other shaders,
  /// such as those of another build, and damaged records are left out. Returns the number of pipelines.
  std::size_t make_pipelines(std::string_view record, std::span<const gpu::ShaderCode* const> shaders);
  /// Lists systems and passes as text, for users and tests.
  [[nodiscard]] std::string describe() const;

 private:
  explicit Renderer(std::unique_ptr<RendererParts> parts);
  std::unique_ptr<RendererParts> parts_;
};

}  // namespace gloam
