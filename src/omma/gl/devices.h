// What EGL lists, without a context.
#pragma once

namespace omma::gl {

/// Whether EGL lists a device that is no software rasterizer; whether it can be used, a context shows. Asking takes
/// some milliseconds, a context that draws on the processor a hundred. Never throws.
bool lists_hardware_device();

}  // namespace omma::gl
