# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Public headers that have moved into rooms: the old path, then the new one. Hosts may include either. Sources of this
# project include the new one (tests/hygiene/include_arrows.py refuses paths that are not in the tree).
set(moved
  engine/core/byte_stream.h
    engine/core/storage/byte_stream.h
  engine/core/nearest_name.h
    engine/core/text/nearest_name.h
  engine/core/plain_text.h
    engine/core/text/plain_text.h
  engine/core/processor_time.h
    engine/core/system/process.h
  engine/core/sealed_file.h
    engine/core/storage/sealed_file.h
  engine/ecs/archetype.h
    engine/ecs/storage/archetype.h
  engine/ecs/query.h
    engine/ecs/storage/query.h
  engine/ecs/virtual_memory.h
    engine/ecs/storage/virtual_memory.h
  engine/frame/frame_results.h
    engine/frame/transfers/results.h
  engine/frame/readback.h
    engine/frame/transfers/readback.h
  engine/frame/staging.h
    engine/frame/transfers/staging.h
  engine/frame/upload.h
    engine/frame/transfers/upload.h
  engine/gpu/recording_device.h
    engine/gpu/recording/device.h
  engine/gpu/spirv_reflection.h
    engine/gpu/spirv/reflection.h
  engine/render/passes/passes.h
    engine/render/passes/renderer_passes.h
  engine/scene/animated_nodes.h
    engine/scene/posing/animated_nodes.h
  engine/scene/animation.h
    engine/scene/posing/animation.h
  engine/scene/asset_check.h
    engine/scene/assets/check.h
  engine/scene/asset_hash.h
    engine/scene/assets/hash.h
  engine/scene/gltf_import.h
    engine/scene/gltf/import.h
  engine/scene/image_file.h
    engine/scene/decoding/image_file.h
  engine/scene/key_registry.h
    engine/scene/keys/registry.h
  engine/scene/key_table.h
    engine/scene/keys/table.h
  engine/scene/mesh_builder.h
    engine/scene/assets/mesh_builder.h
  engine/scene/topology.h
    engine/scene/assets/topology.h
  engine/scene/value.h
    engine/scene/keys/value.h
  shaders/reflections/planar/planar_shared.h
    shaders/reflections/passes/planar_shared.h
  shaders/render/host_geometry_shared.h
    shaders/render/gbuffer/host_geometry_shared.h
  shaders/render/smooth_surface_shared.h
    shaders/render/gbuffer/smooth_surface_shared.h
)
while(moved)
  list(POP_FRONT moved old new)
  if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${new})
    message(FATAL_ERROR "cmake/GloamMovedHeaders.cmake: ${new} does not exist")
  endif()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${old} CONTENT "#pragma once\n#include \"${new}\"\n")
  if(GLOAM_INSTALL)
    get_filename_component(folder ${old} DIRECTORY)
    install(FILES ${PROJECT_BINARY_DIR}/generated/${old} DESTINATION include/gloam/${folder} COMPONENT gloam)
  endif()
endwhile()
