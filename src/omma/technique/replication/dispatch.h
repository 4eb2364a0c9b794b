// Compute shaders of 64 invocations, as all of technique/replication/ are.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>

namespace omma {

constexpr uint32_t group_size = 64;

constexpr uint32_t divided_up(uint32_t value, uint32_t by) { return (value + by - 1) / by; }

/// Runs the program in use in so many groups, in rows: gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x is a
/// group's number, and there may be a few too many. Whatever follows sees what was written.
inline void dispatch(uint32_t groups) {
  constexpr uint32_t groups_a_row = 32768;  // drivers take 65535 at least
  if (groups == 0) return;
  glDispatchCompute(std::min(groups, groups_a_row), divided_up(groups, groups_a_row), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace omma
