// The ways to draw that this machine has: the processor always, OpenGL where there is a driver. Outlives scenes, for
// what it knows takes long to learn: drivers, and programs, which take longer to compile than pictures to draw.
#pragma once

#include <memory>

namespace omma {

/// Several scenes may be prepared on one device, and each lives on when the device goes. Any number of threads may draw
/// at once: on the processor beside each other, by OpenGL, which has one context, in turn. What was current on a thread
/// by EGL before is current again afterwards.
class Device {
 public:
  /// Opens nothing: the first picture that needs OpenGL does.
  Device();
  ~Device();
  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;

  /// Whether OpenGL draws on a graphics processor. Opens a context of its own only where EGL lists one.
  bool has_gpu() const;
  /// Opens a context of its own now. Throws MachineError when there is none to be had.
  void open_gl();

  struct Parts;  ///< device_parts.h
  const std::shared_ptr<Parts>& parts() const { return parts_; }

 private:
  std::shared_ptr<Parts> parts_;
};

}  // namespace omma
