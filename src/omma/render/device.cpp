#include "omma/render/device.h"

#include "omma/base/error.h"
#include "omma/gl/devices.h"
#include "omma/render/device_parts.h"

namespace omma {

GlDevice::GlDevice() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_CLAMP);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

Device::Parts::~Parts() {
  if (!gl) return;
  try {
    const gl::Current current(gl->context);
    gl.reset();
  } catch (const MachineError&) {
    // Current on another thread: nothing of it can be deleted here.
    (void)gl.release();
  }
}

GlDevice& Device::Parts::open() {
  if (!gl) gl = std::make_unique<GlDevice>();
  gpu = !gl->context.software();
  return *gl;
}

bool Device::Parts::has_gpu() {
  if (!gpu && !gl::lists_hardware_device()) gpu = false;
  if (!gpu) {
    try {
      open();
    } catch (const MachineError&) {
      gpu = false;
    }
  }
  return *gpu;
}

Device::Device() : parts_(std::make_shared<Parts>()) {}
Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

bool Device::has_gpu() const {
  const std::lock_guard lock(parts_->mutex);
  const gl::Current before;
  return parts_->has_gpu();
}

void Device::open_gl() {
  const std::lock_guard lock(parts_->mutex);
  const gl::Current before;
  parts_->open();
}

}  // namespace omma
