// omma doctor: what this machine can do, and why not more.
#include <assimp/version.h>
#include <embree3/rtcore_config.h>
#include <fmt/core.h>
#include <oneapi/tbb/version.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "commands.h"
#include "omma/base/error.h"
#include "omma/gl/context.h"
#include "omma/image/codec/decode.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"
#include "omma/technique/registry.h"

namespace omma::tool {
namespace {

/// The value of the first line `key : value` of a file in /proc; "unknown" when there is none.
std::string proc_value(const char* file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "unknown" : line.substr(begin);
  }
  return "unknown";
}

void print_machine() {
  const double gibibytes = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGE_SIZE)) / (1 << 30);
  fmt::print("machine\n");
  fmt::print("  CPU             {}\n", proc_value("/proc/cpuinfo", "model name"));
  fmt::print("  threads         {}\n", std::thread::hardware_concurrency());
  fmt::print("  memory          {:.1f} GiB\n", gibibytes);
}

void print_versions() {
  fmt::print("libraries\n");
  fmt::print("  omma            {}\n", OMMA_VERSION);
  fmt::print("  assimp          {}.{}.{}\n", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
  fmt::print("  Embree          {}\n", RTC_VERSION_STRING);
  fmt::print("  oneTBB          {}\n", TBB_runtime_version());
  for (const auto& [name, version] : codec_versions()) fmt::print("  {:<16}{}\n", name, version);
}

void print_devices() {
  const std::vector<gl::DeviceReport> devices = gl::probe_devices();
  fmt::print("EGL devices (the first usable GPU is taken, else the first usable software rasterizer)\n");
  if (devices.empty()) fmt::print("  none: EGL finds no device, or libEGL does not load\n");
  for (const gl::DeviceReport& device : devices) {
    fmt::print("  {:<9}{} {}{}{}\n", device.usable ? "usable" : "unusable", device.software ? "(software) " : "",
               device.name, device.version.empty() ? "" : ", OpenGL " + device.version,
               device.reason.empty() ? "" : ": " + device.reason);
  }
}

void print_context(const gl::Context& context) {
  const gl::Limits& limits = context.limits();
  fmt::print("taken: {}, OpenGL {}{}\n", context.renderer(), context.version(),
             context.software() ? " (no usable GPU: pictures are right, but slow)" : "");
  fmt::print("  texture side    {}\n", limits.texture_size);
  fmt::print("  viewport side   {} (larger images are drawn in tiles)\n", limits.viewport_size);
  fmt::print("  samples         {} (more are accumulated)\n", limits.samples);
  fmt::print("  array layers    {}\n", limits.array_layers);
  fmt::print("  buffer texels   {}\n", limits.buffer_texels);
  fmt::print("  storage bytes   {}\n", limits.storage_bytes);
  fmt::print("  64-bit atomics  {}\n", limits.atomics_64 ? "yes" : "no (visibility:gpu takes two passes)");
  fmt::print("  anisotropy      {}\n", limits.anisotropy);
}

/// Draws a small picture and says how that went. Returns whether there is one.
bool try_technique(const PreparedScene& scene, const std::string& technique) {
  const Camera camera = make_camera("perspective:fov_deg=90", ImageSize{64, 64});
  const glm::dmat4 worldFromCamera = look_at_worldFromCamera(scene.scene().default_from, scene.scene().default_to);
  const Channel channels[] = {Channel::color};
  RenderOptions options;
  options.technique = technique;
  try {
    const auto begin = std::chrono::steady_clock::now();
    scene.render(camera, worldFromCamera, channels, options);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    fmt::print("  {:<24}works, {:.1f} ms\n", technique, time.count());
    return true;
  } catch (const Error& error) {
    fmt::print("  {:<24}does not work: {}\n", technique, error.what());
    return false;
  }
}

bool try_techniques() {
  fmt::print("techniques (first picture of 64 x 64 pixels, programs being compiled)\n");
  const PreparedScene scene(Device(), load_scene("facade"));
  bool all = true;
  for (const TechniqueInfo& technique : techniques()) {
    if (technique.variants.empty()) all &= try_technique(scene, technique.name);
    for (const VariantInfo& variant : technique.variants) {
      all &= try_technique(scene, technique.name + ":" + variant.name);
    }
  }
  return all;
}

void run() {
  print_machine();
  print_versions();
  print_devices();
  try {
    print_context(gl::Context());
  } catch (const MachineError& error) {
    throw MachineError("{}\n{}", error.what(), what_works_without_gl());
  }
  if (!try_techniques()) throw MachineError("some techniques do not work on this machine, as listed");
}

}  // namespace

void add_doctor(const Command& tool) {
  const Command command = tool.add_command("doctor", "Say what this machine can do, and why not more");
  command.footer(
      "Lists the OpenGL devices, the one that is taken and its limits, and draws a small picture with each technique.\n"
      "Exit code 4 when something does not work. The environment variable OMMA_GL_DEBUG=print shows what the driver\n"
      "says.\n"
      "Example:\n"
      "  omma doctor");
  command.callback(run);
}

}  // namespace omma::tool
