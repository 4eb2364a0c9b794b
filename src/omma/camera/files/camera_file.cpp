#include "omma/camera/files/camera_file.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"
#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

constexpr const CameraFormat* formats[] = {
#define OMMA_CAMERA_FORMAT(name) &name##_format,
#include "omma/camera/files/formats.def"
#undef OMMA_CAMERA_FORMAT
};

constexpr std::array<const char*, 8> extensions = {".yaml", ".yml", ".json", ".xml", ".txt", ".sdf", ".world", ".ini"};

bool is_existing_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

std::string list(const std::vector<std::string>& names) {
  constexpr size_t most = 24;
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), most); ++i) text += (i ? ", " : "") + names[i];
  return names.size() > most ? fmt::format("{}, … ({} in all)", text, names.size()) : text;
}

// .yml is .yaml.
std::string extension_of(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".yml" ? ".yaml" : extension;
}

const CameraFormat& format_to_write(const std::filesystem::path& path, std::string_view name) {
  std::vector<std::string> writable, fitting;
  const CameraFormat* found = nullptr;
  for (const CameraFormat* format : formats) {
    if (!format->write) continue;
    writable.emplace_back(format->name);
    if (name == format->name) return *format;
    if (extension_of(path) == format->extension) {
      fitting.emplace_back(format->name);
      found = format;
    }
  }
  if (!name.empty()) throw CommandError("--format: {}", unknown_name("format", name, writable));
  if (fitting.size() == 1) return *found;
  if (fitting.empty()) {
    throw CommandError(
        "{}: no calibration file has the extension '{}'; say with --format which it is to be (one of: {})",
        path.string(), path.extension().string(), list(writable));
  }
  throw CommandError("{}: several formats have this extension; say with --format which it is to be (one of: {})",
                     path.string(), list(fitting));
}

}  // namespace

std::span<const CameraFormat* const> camera_formats() { return formats; }

CameraFile CameraFile::load(const std::filesystem::path& path, const Limits& limits) {
  return parse(path.string(), read_file(path, limits, &Limits::document_bytes), limits);
}

CameraFile CameraFile::parse(std::string file, std::string_view text, const Limits& limits) {
  const auto document = std::make_shared<const Document>(parse_document(std::move(file), text, limits));
  std::vector<const CameraFormat*> found;
  for (const CameraFormat* format : formats) {
    if (format->recognises(*document)) found.push_back(format);
  }
  if (found.empty()) {
    std::string known;
    for (const CameraFormat* format : formats) {
      known += fmt::format("\n  {:<11} {}", format->name, format->recognised);
    }
    document->place().fail("is no calibration file that is known. What is known, and by what:{}", known);
  }
  if (found.size() > 1) {
    std::vector<std::string> names;
    for (const CameraFormat* format : found) names.emplace_back(format->name);
    document->place().fail("could be of several formats ({}); take away what belongs to the others", list(names));
  }
  CameraFile result;
  result.file_ = document->file;
  result.format_ = found.front();
  result.entries_ = result.format_->read(document);
  if (result.entries_.empty()) document->place().fail("holds no camera");
  std::vector<std::string> names = result.names();
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice != names.end()) document->place().fail("has two cameras named '{}'", *twice);
  return result;
}

const char* CameraFile::format() const { return format_->name; }

std::vector<std::string> CameraFile::names() const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_) names.push_back(entry.name);
  return names;
}

Camera CameraFile::camera(std::string_view name) const {
  const auto found = std::ranges::find(entries_, name, &Entry::name);
  if (found == entries_.end()) throw CommandError("{}: {}", file_, unknown_name("camera", name, names()));
  return found->read();
}

Camera CameraFile::camera() const {
  if (entries_.size() > 1) {
    throw CommandError("{}: holds several cameras; choose one, for example {}#{} (one of: {})", file_, file_,
                       entries_.front().name, list(names()));
  }
  return entries_.front().read();
}

std::optional<CameraFileText> camera_file_text(std::string_view text) {
  const auto is_file_name = [](const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    return std::ranges::any_of(extensions, [&](const char* known) { return extension == known; }) ||
           (is_existing_file(path) && !find_lens_model(path.string()));
  };
  if (is_file_name(text)) return CameraFileText{text, {}};
  const size_t hash = text.rfind('#');
  if (hash == std::string_view::npos || !is_file_name(text.substr(0, hash))) return {};
  return CameraFileText{text.substr(0, hash), std::string(text.substr(hash + 1))};
}

Camera load_camera(const CameraFileText& text, const Limits& limits) {
  const CameraFile file = CameraFile::load(text.path, limits);
  return text.name ? file.camera(*text.name) : file.camera();
}

void write_camera_file(const std::filesystem::path& path, std::span<const NamedCamera> cameras,
                       std::string_view format) {
  if (cameras.empty()) throw CommandError("{}: there is no camera to write", path.string());
  write_text(path, format_to_write(path, format).write(cameras));
}

void require_camera_format(const std::filesystem::path& path, std::string_view format) {
  format_to_write(path, format);
}

std::string camera_format_table() {
  std::string text =
      "| format | what | recognised by | camera models | conventions | written |\n"
      "|---|---|---|---|---|---|\n";
  for (const CameraFormat* format : formats) {
    text +=
        fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", format->name, format->what, format->recognised,
                    format->models, format->convention, format->write ? fmt::format("`{}`", format->extension) : "–");
  }
  return text;
}

}  // namespace omma
