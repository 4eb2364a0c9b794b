// Pictures of rare formats, by OpenImageIO. It brings some 250 libraries, so it is linked to a module of its own that
// is loaded when the first such picture is met.
#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "omma/base/error.h"
#include "omma/image/codec/decode.h"
#include "omma/image/codec/openimageio/module.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

/// Beside the program, as in the build and where the tool is installed; else where this library was to be installed.
std::vector<fs::path> module_places() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  return {(program.parent_path() / OMMA_MODULE_FROM_PROGRAM).lexically_normal(), fs::path(OMMA_INSTALLED_MODULE)};
}

struct Module {
  OpenImageIODecode decode = nullptr;
  std::string why_not;
};

Module load() {
  Module module;
  for (const fs::path& path : module_places()) {
    void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      module.why_not += fmt::format("{}{}", module.why_not.empty() ? "" : "; ", ::dlerror());
      continue;
    }
    module.decode = reinterpret_cast<OpenImageIODecode>(::dlsym(library, OMMA_OPENIMAGEIO_DECODE));
    if (module.decode != nullptr) return module;
    module.why_not = ::dlerror();
  }
  return module;
}

}  // namespace

Pixels decode_by_openimageio(std::string_view bytes, const std::string& extension, const Accept& accept) {
  static const Module module = load();
  if (module.decode == nullptr) {
    throw InputError("it is a picture {}, which Omma reads by its module for OpenImageIO, and that does not load: {}",
                     extension.empty() ? "of a rare or no known format" : "in " + extension, module.why_not);
  }
  Pixels pixels;
  module.decode(bytes, extension, accept, pixels);
  return pixels;
}

}  // namespace omma
