// What a device is made of, for those who draw with it.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "omma/gl/context.h"
#include "omma/render/device.h"
#include "omma/technique/camera_program.h"
#include "omma/technique/sample_places.h"

namespace omma {

/// OpenGL, as long as the device lasts. Used while its context is current.
struct GlDevice {
  gl::Context context;
  ProgramCache programs;
  SamplePlaces sample_places;
  GlDevice();
};

struct Device::Parts {
  ~Parts();
  std::mutex mutex;  ///< of all that follows, and of everything that is drawn by OpenGL
  std::unique_ptr<GlDevice> gl;
  std::optional<bool> gpu;

  /// Both with the mutex held, by a thread that puts back what was current before (gl::Current).
  GlDevice& open();
  bool has_gpu();
};

}  // namespace omma
