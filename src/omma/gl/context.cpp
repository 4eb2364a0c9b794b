#include "omma/gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "omma/base/error.h"
#include "omma/gl/devices.h"

namespace omma::gl {
namespace {

std::vector<EGLDeviceEXT> egl_devices() {
  // Asked for by address: libepoxy aborts on functions whose extension it has not seen on a display yet.
  const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLint count = 0;
  if (query == nullptr || !query(0, nullptr, &count)) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
  if (!query(count, devices.data(), &count)) return {};
  devices.resize(static_cast<size_t>(count));
  return devices;
}

bool is_software(EGLDeviceEXT device) {
  const auto query = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
  const char* extensions = query != nullptr ? query(device, EGL_EXTENSIONS) : nullptr;
  return extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
}

std::string egl_error() { return fmt::format("EGL error 0x{:04x}", eglGetError()); }

/// A display and a context on it; both go with this object.
struct Connection {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (context != EGL_NO_CONTEXT) {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroyContext(display, context);
    }
    // The display stays: EGL shares it between all contexts of a process.
  }

  /// Empty when it worked, else the reason why not.
  std::string open(EGLDeviceEXT device) {
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_display == nullptr) return "EGL has no platform displays";
    display = get_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (display == EGL_NO_DISPLAY) return "no EGL display: " + egl_error();
    EGLint major = 0, minor = 0;
    if (!eglInitialize(display, &major, &minor)) return "EGL does not initialize: " + egl_error();
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
      if (extensions == nullptr || std::strstr(extensions, needed) == nullptr) {
        return fmt::format("lacks {}", needed);
      }
    }
    if (!eglBindAPI(EGL_OPENGL_API)) return "EGL has no OpenGL: " + egl_error();
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 std::getenv("OMMA_GL_DEBUG") != nullptr,
                                 EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) return "no OpenGL 4.5 core context: " + egl_error();
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
      return "the context cannot be made current: " + egl_error();
    }
    return {};
  }
};

std::string gl_string(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "";
}

/// True where epoxy finds EGL at all; without this check its first call would abort the program.
bool egl_present() { return epoxy_has_egl(); }

void GLAPIENTRY on_debug_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                                 const void* fatal) {
  if (severity == GL_DEBUG_SEVERITY_NOTIFICATION || type == GL_DEBUG_TYPE_PERFORMANCE) return;
  fmt::print(stderr, "GL: {}\n", message);
  if (fatal != nullptr && (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)) {
    std::abort();
  }
}

void listen_to_debug_output() {
  const char* mode = std::getenv("OMMA_GL_DEBUG");
  if (mode == nullptr) return;
  static const char fatal_marker = 0;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_debug_message, std::strcmp(mode, "fatal") == 0 ? &fatal_marker : nullptr);
}

int get_integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

Limits read_limits() {
  Limits limits;
  limits.texture_size = get_integer(GL_MAX_TEXTURE_SIZE);
  GLint viewport[2] = {0, 0};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  limits.viewport_size = std::min(viewport[0], viewport[1]);
  limits.samples = std::min({get_integer(GL_MAX_SAMPLES), get_integer(GL_MAX_COLOR_TEXTURE_SAMPLES),
                             get_integer(GL_MAX_DEPTH_TEXTURE_SAMPLES)});
  limits.array_layers = get_integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
  limits.buffer_texels = get_integer(GL_MAX_TEXTURE_BUFFER_SIZE);
  GLint64 storage_bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage_bytes);
  limits.storage_bytes = size_t(storage_bytes);
  limits.atomics_64 =
      epoxy_has_gl_extension("GL_NV_shader_atomic_int64") && epoxy_has_gl_extension("GL_ARB_gpu_shader_int64");
  limits.anisotropy = 1.0f;
  if (epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic") ||
      epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &limits.anisotropy);
  }
  return limits;
}

}  // namespace

std::vector<DeviceReport> probe_devices() {
  std::vector<DeviceReport> reports;
  if (!egl_present()) return reports;
  for (EGLDeviceEXT device : egl_devices()) {
    DeviceReport report;
    report.software = is_software(device);
    report.name = report.software ? "software device" : "hardware device";
    Connection connection;
    report.reason = connection.open(device);
    report.usable = report.reason.empty();
    if (report.usable) {
      report.name = gl_string(GL_RENDERER);
      report.version = gl_string(GL_VERSION);
    }
    reports.push_back(report);
  }
  return reports;
}

bool lists_hardware_device() {
  if (!egl_present()) return false;
  const std::vector<EGLDeviceEXT> devices = egl_devices();
  return std::any_of(devices.begin(), devices.end(), [](EGLDeviceEXT device) { return !is_software(device); });
}

struct Context::State {
  Connection connection;
  std::string renderer, version;
  bool software = false;
  Limits limits;
};

Context::Context() : state_(std::make_unique<State>()) {
  if (!egl_present()) {
    throw MachineError("no usable OpenGL: libEGL is missing; install the packages libegl1 and libgl1-mesa-dri");
  }
  std::vector<EGLDeviceEXT> devices = egl_devices();
  std::stable_partition(devices.begin(), devices.end(), [](EGLDeviceEXT device) { return !is_software(device); });
  std::string tried;
  for (EGLDeviceEXT device : devices) {
    auto state = std::make_unique<State>();
    const std::string reason = state->connection.open(device);
    if (!reason.empty()) {
      tried += fmt::format("\n  {} device: {}", is_software(device) ? "software" : "hardware", reason);
      continue;
    }
    state->renderer = gl_string(GL_RENDERER);
    state->version = gl_string(GL_VERSION);
    state->software = is_software(device) || state->renderer.find("llvmpipe") != std::string::npos;
    state->limits = read_limits();
    state_ = std::move(state);
    listen_to_debug_output();
    return;
  }
  if (tried.empty()) tried = "\n  EGL lists no devices";
  throw MachineError(
      "no usable OpenGL 4.5 on this machine; tried:{}\ninstall a GPU driver with EGL, or Mesa's software rasterizer "
      "(package libgl1-mesa-dri)",
      tried);
}

Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

void Context::make_current() const {
  const EGLContext context = state_->connection.context;
  if (eglGetCurrentContext() == context) return;
  eglBindAPI(EGL_OPENGL_API);
  if (!eglMakeCurrent(state_->connection.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    throw MachineError("the OpenGL context cannot be made current on this thread: {}", egl_error());
  }
}

Current::Current()
    : display_(EGL_NO_DISPLAY), draw_(EGL_NO_SURFACE), read_(EGL_NO_SURFACE), context_(EGL_NO_CONTEXT), api_(0) {
  if (!egl_present()) return;
  api_ = eglQueryAPI();
  eglBindAPI(EGL_OPENGL_API);
  display_ = eglGetCurrentDisplay();
  draw_ = eglGetCurrentSurface(EGL_DRAW);
  read_ = eglGetCurrentSurface(EGL_READ);
  context_ = eglGetCurrentContext();
}

Current::~Current() {
  if (api_ == 0) return;
  if (eglGetCurrentContext() != context_) {
    const EGLDisplay display = context_ != EGL_NO_CONTEXT ? display_ : eglGetCurrentDisplay();
    if (display != EGL_NO_DISPLAY) eglMakeCurrent(display, draw_, read_, context_);
  }
  eglBindAPI(EGLenum(api_));
}
const std::string& Context::renderer() const { return state_->renderer; }
const std::string& Context::version() const { return state_->version; }
bool Context::software() const { return state_->software; }
const Limits& Context::limits() const { return state_->limits; }

}  // namespace omma::gl
