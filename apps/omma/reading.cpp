#include "reading.h"

#include <fmt/format.h>

#include <filesystem>

#include "omma/base/error.h"

namespace omma::tool {
namespace {

constexpr const char* group = "Files";

std::string limit_help() {
  std::string text = "Raises or lowers what a file may ask for, see docs/limits.md; may be given several times:";
  const Limits defaults;
  for (const LimitInfo& info : limit_infos()) {
    text += fmt::format("{} {} ({})", info.value == &Limits::file_bytes ? "" : ",", info.name, defaults.*info.value);
  }
  return text;
}

}  // namespace

void add_limits(const Command& command, ReadingOptions& options) {
  command.add_option("--limit", options.limits, limit_help()).type_name("NAME=N").one_word().group(group);
}

void add_root(const Command& command, ReadingOptions& options) {
  command
      .add_option("--root", options.root,
                  "Textures, buffers and other files that the scene file names are read within DIR, too; default only "
                  "within the scene file's folder")
      .type_name("DIR")
      .group(group);
}

ReadOptions read_options_of(const ReadingOptions& options) {
  ReadOptions result;
  for (const std::string& text : options.limits) set_limit(result.limits, text);
  if (!options.root) return result;
  std::error_code ignored;
  if (!std::filesystem::is_directory(*options.root, ignored)) {
    throw CommandError("--root {}: there is no such folder", *options.root);
  }
  result.root = *options.root;
  return result;
}

}  // namespace omma::tool
