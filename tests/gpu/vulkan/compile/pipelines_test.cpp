// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/pipelines.h"

#include <array>
#include <numeric>
#include <thread>

#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

class Pipelines : public VulkanTest {
 protected:
  ComputePipelineDesc doubling(SpecConstants constants = {}) {
    return {.name = "double numbers",
            .module = "test",
            .shader = shaders::gpu_test::double_numbers_comp,
            .constants = std::move(constants)};
  }

  /// Runs the kernel on the numbers 0 … 99, of which it processes 90; the uniform adds 1000.
  std::vector<std::uint32_t> run(PipelineHandle pipeline) {
    std::vector<std::uint32_t> numbers(100);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const BufferHandle source = test::make_upload(device(), numbers);
    const BufferHandle uniform = test::make_upload(device(), std::vector<std::uint32_t>{1000});
    const BufferHandle target = test::make_storage(device(), 400);
    const BufferHandle readback = test::make_readback(device(), 400);
    test::run_frame(device(), [&](CommandList& commands) {
      commands.fill_buffer(target, 0, 400, 7);
      to(commands, target, Access::transfer_write, Access::compute_write);
      commands.begin_label("double");
      commands.bind_pipeline(pipeline);
      commands.bind(std::array{Binding{0, Binding::BufferRange{source}}, Binding{1, Binding::BufferRange{target}},
                               Binding{2, Binding::BufferRange{uniform}}});
      commands.push(std::uint32_t{90});
      commands.dispatch(2, 1, 1);
      commands.end_label();
      to(commands, target, Access::compute_write, Access::transfer_read);
      commands.copy_buffer(target, 0, readback, 0, 400);
      to(commands, readback, Access::transfer_write, Access::host_read);
    });
    return test::items_of<std::uint32_t>(device(), readback);
  }
};

TEST_F(Pipelines, a_kernel_sees_buffers_uniforms_and_push_constants) {
  const auto result = run(test::value_of(device().create_pipeline(doubling())));
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(result[i], i < 90 ? 2 * i + 1000 : 7);
}

TEST_F(Pipelines, specialisation_constants_reach_the_kernel) {
  const auto result = run(test::value_of(device().create_pipeline(doubling({{"kScale", 5u}}))));
  EXPECT_EQ(result[3], 1015u);
}

TEST_F(Pipelines, constants_that_the_shader_does_not_take_assert_with_pipeline_shader_and_name) {
  EXPECT_ASSERT(
      (void)device().create_pipeline(doubling({{"kStale", 5u}})),
      "pipeline 'double numbers', shader 'gpu_test/double_numbers.comp', constant 'kStale': the program has no "
      "specialisation constant of this name");
  EXPECT_ASSERT((void)device().create_pipeline(doubling({{"kScale", 5.0f}})),
                "constant 'kScale': the shader declares it as uint, and the value is of type float");
  SpecConstants shared;
  shared.set_if_present("kStale", 5u);
  EXPECT_TRUE(device().create_pipeline(doubling(shared)).ok());
}

/// The results of disabled_code.comp for the sources 0 … 63.
std::vector<std::uint32_t> without_disabled_code(std::uint32_t mode, bool twice, int steps, float factor) {
  const auto steps_to_one = [](std::uint32_t v) {
    std::uint32_t count = 0;
    for (; v > 1; ++count) v = v % 2 == 0 ? v / 2 : 3 * v + 1;
    return count;
  };
  std::vector<std::uint32_t> results;
  for (std::uint32_t v = 0; v < 64; ++v) {
    std::uint32_t sum = 0;
    for (int step = 0; step < steps; ++step) {
      sum += v + static_cast<std::uint32_t>(step);
      if (mode == 1 && sum > 50) break;
      if (mode != 2) sum ^= 5u;
    }
    ++sum;
    while (mode != 3 && sum % 7 != 0) ++sum;
    if (mode == 4) sum += v % 2 == 0 ? steps_to_one(v) : 3;
    for (std::uint32_t step = 0; mode == 5 && step < v % 4; ++step) sum = sum * 3 + 1;
    if (twice) sum = mode > 2 ? sum * 2 + 1 : sum * 2;
    results.push_back(sum + static_cast<std::uint32_t>(static_cast<float>(v) * factor));
  }
  return results;
}

TEST_F(Pipelines, kernels_compute_the_same_without_disabled_code) {
  std::vector<std::uint32_t> numbers(64);
  std::iota(numbers.begin(), numbers.end(), 0u);
  const BufferHandle source = test::make_upload(device(), numbers);
  for (std::uint32_t mode = 0; mode < 6; ++mode) {
    for (const bool twice : {false, true}) {
      const int steps = static_cast<int>(mode + (twice ? 1 : 0)) % 4;
      const float factor = 0.5f + static_cast<float>(mode);
      const auto pipeline = test::value_of(device().create_pipeline(ComputePipelineDesc{
          .name = "disabled code",
          .module = "test",
          .shader = shaders::gpu_test::disabled_code_comp,
          .constants = {{"kMode", mode}, {"kTwice", twice}, {"kSteps", steps}, {"kFactor", factor}}}));
      const BufferHandle target = test::make_readback(device(), 256);
      test::run_frame(device(), [&](CommandList& commands) {
        commands.bind_pipeline(pipeline);
        commands.bind(std::array{Binding{0, Binding::BufferRange{source}}, Binding{1, Binding::BufferRange{target}}});
        commands.dispatch(1, 1, 1);
        to(commands, target, Access::compute_write, Access::host_read);
      });
      EXPECT_EQ(test::items_of<std::uint32_t>(device(), target), without_disabled_code(mode, twice, steps, factor))
          << "mode " << mode << ", twice " << twice;
    }
  }
}

TEST_F(Pipelines, kernels_choose_vectors_by_specialisation_constants) {
  constexpr float kFactor = 0.25f;
  for (std::uint32_t flag = 0; flag < 3; ++flag) {
    const auto pipeline = test::value_of(
        device().create_pipeline(ComputePipelineDesc{.name = "choose vectors",
                                                     .module = "test",
                                                     .shader = shaders::gpu_test::choose_vectors_comp,
                                                     .constants = {{"kFlag", flag}, {"kFactor", kFactor}}}));
    const BufferHandle target = test::make_readback(device(), 36);
    test::run_frame(device(), [&](CommandList& commands) {
      commands.bind_pipeline(pipeline);
      commands.bind(std::array{Binding{0, Binding::BufferRange{target}}});
      commands.dispatch(1, 1, 1);
      to(commands, target, Access::compute_write, Access::host_read);
    });
    std::vector<float> expected = flag != 0 ? std::vector{1.0f, 2.0f} : std::vector{3.0f, 4.0f};
    const std::vector scale = flag > 1 ? std::vector{kFactor, 5.0f, 6.0f} : std::vector{7.0f, 8.0f, kFactor};
    expected.insert(expected.end(), scale.begin(), scale.end());
    const std::vector nested = flag == 1 ? std::vector(3, 9.0f) : scale;
    expected.insert(expected.end(), nested.begin(), nested.end());
    expected.push_back(flag == 2 ? kFactor : 10.0f);
    EXPECT_EQ(test::items_of<float>(device(), target), expected) << "flag " << flag;
  }
}

std::uint32_t halvings(std::uint32_t v) {
  std::uint32_t count = 0;
  for (; v > 1; v /= 2) ++count;
  return count;
}

/// What uniform_branches.comp.glsl computes, by kind of branch.
std::uint32_t after_branches(std::uint32_t kind, std::uint32_t v, std::uint32_t number) {
  const std::array<std::uint32_t, 4> elements = {2, 4, 8, 1};
  std::uint32_t sum = v;
  if ((kind == 0 || kind == 1) && number > 3) sum += halvings(v);
  for (std::uint32_t k = 0; kind == 2 && k < number; ++k) sum = sum * 3 + k + v % 5;
  if (kind == 3) sum += halvings(number);
  if (kind == 4) sum += number > 3 ? (v > 7 ? 6 : 7) + halvings(v) : 5;
  if (kind == 5 && v > 3) sum += halvings(v);
  for (std::uint32_t k = 0; kind == 6 && k < 4; ++k) sum = sum * 3 + elements[k];
  if (kind == 7 && elements[v % 4] > 3) sum += halvings(v);
  return sum;
}

// On lavapipe these branches are changed: see engine/gpu/spirv/runtime_conditions.h.
TEST_F(Pipelines, branches_that_uniforms_decide_compute_the_same_for_all_values) {
  std::vector<std::uint32_t> numbers(64);
  std::iota(numbers.begin(), numbers.end(), 0u);
  const BufferHandle source = test::make_upload(device(), numbers);
  for (std::uint32_t kind = 0; kind < 8; ++kind) {
    const auto pipeline =
        test::value_of(device().create_pipeline(ComputePipelineDesc{.name = "uniform branches",
                                                                    .module = "test",
                                                                    .shader = shaders::gpu_test::uniform_branches_comp,
                                                                    .constants = {{"kKind", kind}}}));
    for (const std::uint32_t number : {0u, 3u, 4u, 9u}) {
      const BufferHandle uniform = test::make_upload(device(), std::vector<std::uint32_t>{number, 2, 4, 8, 1});
      const BufferHandle target = test::make_readback(device(), 256);
      test::run_frame(device(), [&](CommandList& commands) {
        commands.bind_pipeline(pipeline);
        commands.bind(std::array{Binding{0, Binding::BufferRange{uniform}}, Binding{1, Binding::BufferRange{source}},
                                 Binding{2, Binding::BufferRange{target}}});
        commands.push(number);
        commands.dispatch(1, 1, 1);
        to(commands, target, Access::compute_write, Access::host_read);
      });
      std::vector<std::uint32_t> expected(64);
      for (std::uint32_t v = 0; v < 64; ++v) expected[v] = after_branches(kind, v, number);
      EXPECT_EQ(test::items_of<std::uint32_t>(device(), target), expected) << "kind " << kind << ", number " << number;
    }
  }
}

TEST_F(Pipelines, dispatches_read_their_size_from_a_buffer) {
  const auto pipeline = test::value_of(device().create_pipeline(doubling()));
  const BufferHandle source = test::make_upload(device(), std::vector<std::uint32_t>(64, 21));
  const BufferHandle uniform = test::make_upload(device(), std::vector<std::uint32_t>{0});
  const BufferHandle arguments = test::make_upload(device(), std::vector<std::uint32_t>{9, 1, 1, 1});
  const BufferHandle target = test::make_readback(device(), 256);
  test::run_frame(device(), [&](CommandList& commands) {
    commands.bind_pipeline(pipeline);
    commands.bind(std::array{Binding{0, Binding::BufferRange{source}}, Binding{1, Binding::BufferRange{target}},
                             Binding{2, Binding::BufferRange{uniform}}});
    commands.push(std::uint32_t{64});
    commands.dispatch_indirect(arguments, 4);
    to(commands, target, Access::compute_write, Access::host_read);
  });
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), target), std::vector<std::uint32_t>(64, 42));
}

TEST_F(Pipelines, are_counted_by_module) {
  EXPECT_EQ(device().pipeline_count("test"), 0u);
  const auto pipeline = test::value_of(device().create_pipeline(doubling()));
  EXPECT_EQ(device().pipeline_count("test"), 1u);
  EXPECT_EQ(device().pipeline_count("other"), 0u);
  device().destroy(pipeline);
  EXPECT_EQ(device().pipeline_count("test"), 0u);
}

TEST_F(Pipelines, compile_on_several_threads_at_once) {
  std::array<PipelineHandle, 4> pipelines;
  std::vector<std::thread> threads;
  for (std::uint32_t i = 0; i < pipelines.size(); ++i) {
    threads.emplace_back([&, i] {
      const auto made = device().create_pipeline(doubling({{"kScale", i + 3}}));
      if (made) pipelines[i] = *made;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::uint32_t i = 0; i < pipelines.size(); ++i) {
    ASSERT_TRUE(pipelines[i]);
    EXPECT_EQ(run(pipelines[i])[2], 1000 + 2 * (i + 3));
  }
}

TEST_F(Pipelines, bad_shaders_are_errors_that_name_pipeline_and_shader) {
  const auto made =
      device().create_pipeline(ComputePipelineDesc{.name = "hopeless", .module = "test", .shader = {"no words", {}}});
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("\"hopeless\""), std::string::npos);
  EXPECT_NE(made.error().message.find("\"no words\""), std::string::npos);
}

TEST_F(Pipelines, bindings_that_do_not_fit_the_shader_assert) {
  const auto pipeline = test::value_of(device().create_pipeline(doubling()));
  const BufferHandle buffer = test::make_storage(device(), 64);
  test::run_frame(device(), [&](CommandList& commands) {
    EXPECT_ASSERT(commands.bind({}), "bound first");
    commands.bind_pipeline(pipeline);
    EXPECT_ASSERT(commands.bind(std::array{Binding{0, Binding::BufferRange{buffer}}}),
                  "needs 1 resource(s) for \"target\" (set 0, binding 1), and was given 0");
    EXPECT_ASSERT(commands.bind(std::array{Binding{0, Binding::Storage{}}}), "is a storage buffer for the shader");
    EXPECT_ASSERT(commands.push_constants({}), "wants 4 bytes of push constants");
    EXPECT_ASSERT(commands.bind_set(1, {}), "has no prepared set 1");
  });
}

}  // namespace
}  // namespace gloam::gpu
