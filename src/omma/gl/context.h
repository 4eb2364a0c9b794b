// An OpenGL 4.5 core context without a window, through EGL: on a GPU where there is one, on Mesa's software
// rasterizer where there is none.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace omma::gl {

/// What one EGL device offers, and why it was or was not taken.
struct DeviceReport {
  std::string name;     ///< EGL's name for it, or the GL renderer where a context could be made
  std::string version;  ///< GL version, empty without a context
  bool software = false;
  bool usable = false;
  std::string reason;  ///< why it is not usable; empty otherwise
};

/// Every EGL device of this machine in EGL's order. Never throws; an EGL that does not load gives an empty list.
std::vector<DeviceReport> probe_devices();

/// What this driver can do, as far as Omma asks.
struct Limits {
  int texture_size = 0;
  int viewport_size = 0;
  int samples = 0;  ///< of every colour, depth and integer format alike
  int array_layers = 0;
  int buffer_texels = 0;     ///< in a buffer texture
  size_t storage_bytes = 0;  ///< in a shader storage block
  bool atomics_64 = false;   ///< shaders can update 64 bits of a storage block at once
  float anisotropy = 0.0f;   ///< 1 where the driver has no anisotropic filtering
};

/// One context, current on the thread that made it and on no other until that lets go of it (Current). The environment
/// variable OMMA_GL_DEBUG makes the driver's debug output visible: `print` shows errors and warnings, `fatal` also ends
/// the program at the first error (tests use it).
class Context {
 public:
  /// Takes the first usable hardware device, else the first usable software device. Throws MachineError saying what
  /// was tried when there is none.
  Context();
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  /// Throws MachineError when it is current on another thread.
  void make_current() const;
  const std::string& renderer() const;
  const std::string& version() const;
  /// A software rasterizer: it has other things that are cheap.
  bool software() const;
  const Limits& limits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whatever is current on this thread is current again when this goes, and may be made current elsewhere meanwhile.
class Current {
 public:
  Current();
  explicit Current(const Context& context) : Current() { context.make_current(); }
  ~Current();
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  void *display_, *draw_, *read_, *context_;
  unsigned api_;
};

}  // namespace omma::gl
