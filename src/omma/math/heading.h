// Rotations as photographers, players of panoramas and ffmpeg's v360 name them: where to look, and how level.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace omma {

/// Radians. What looks along -Z with +Y up first rolls about the way it looks, then looks up, then turns to the side.
struct Heading {
  double yaw = 0.0;    ///< to the right (of north, where -Z is north), a compass's direction
  double pitch = 0.0;  ///< above the horizon
  double roll = 0.0;   ///< clockwise seen from behind: the right side goes down
};

/// From the frame that looks along its own -Z to the one that the angles are measured in.
inline glm::dmat3 rotation_of(const Heading& heading) {
  const double cy = std::cos(heading.yaw), sy = std::sin(heading.yaw);
  const double cp = std::cos(heading.pitch), sp = std::sin(heading.pitch);
  const double cr = std::cos(heading.roll), sr = std::sin(heading.roll);
  const glm::dmat3 turned(cy, 0, sy, 0, 1, 0, -sy, 0, cy);
  const glm::dmat3 raised(1, 0, 0, 0, cp, sp, 0, -sp, cp);
  const glm::dmat3 rolled(cr, -sr, 0, sr, cr, 0, 0, 0, 1);
  return turned * raised * rolled;
}

/// The angles of a rotation: yaw and roll within half a turn, pitch within a quarter. Straight up and down, where yaw
/// and roll turn about one axis, it is all roll.
inline Heading heading_of(const glm::dmat3& rotation) {
  const glm::dvec3 ahead = -rotation[2];
  const double level = std::hypot(ahead.x, ahead.z);
  Heading heading{.pitch = std::atan2(ahead.y, level)};
  if (level > 1e-14) heading.yaw = std::atan2(ahead.x, -ahead.z);
  const glm::dmat3 level_frame = rotation_of({.yaw = heading.yaw, .pitch = heading.pitch});
  const glm::dvec3 right = glm::transpose(level_frame) * rotation[0];
  heading.roll = std::atan2(-right.y, right.x);
  return heading;
}

}  // namespace omma
