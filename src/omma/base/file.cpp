#include "omma/base/file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "omma/base/error.h"

namespace omma {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view unfinished = ".part";

[[noreturn]] void refuse_size(const fs::path& path, const Limits& limits, size_t Limits::*bytes) {
  throw InputError("{}: is larger than {} bytes: {}", path.string(), limits.*bytes, limit_text(limits, bytes));
}

/// Which process writes a file that is not whole yet: PROCESS of `.STEM.PROCESS.part.EXTENSION`.
std::optional<int> writer_of(std::string_view name) {
  if (!name.starts_with('.')) return std::nullopt;
  for (size_t at = name.find(unfinished); at != std::string_view::npos; at = name.find(unfinished, at + 1)) {
    const size_t behind = at + unfinished.size();
    if (behind < name.size() && name[behind] != '.') continue;
    const size_t dot = at > 0 ? name.rfind('.', at - 1) : 0;
    const char* const end = name.data() + at;
    int process = 0;
    const auto [last, error] = std::from_chars(name.data() + dot + 1, end, process);
    if (dot > 0 && error == std::errc() && last == end && process > 0) return process;
  }
  return std::nullopt;
}

}  // namespace

void require_readable(const fs::path& path, const Limits& limits, size_t Limits::*bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError("{}: no such file", path.string());
  if (fs::is_directory(status)) throw InputError("{}: is a folder, a file is expected", path.string());
  // Opening a pipe that nobody writes to would never end.
  if (!fs::is_regular_file(status)) throw InputError("{}: is a pipe or a device, a file is expected", path.string());
  const uintmax_t size = fs::file_size(path, error);
  if (!error && size > limits.*bytes) refuse_size(path, limits, bytes);
}

std::string read_file(const fs::path& path, const Limits& limits, size_t Limits::*bytes) {
  require_readable(path, limits, bytes);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError("{}: cannot be read ({})", path.string(), std::strerror(errno));
  std::string text;
  // What a file system calls its size is where it most likely ends: some say 0 of what they make up while it is read.
  std::error_code error;
  const uintmax_t size = fs::file_size(path, error);
  size_t room = error ? 1 : std::min<uintmax_t>(size, limits.*bytes) + 1;
  for (size_t end = 0;; room = 1U << 16) {
    text.resize(end + room);
    stream.read(text.data() + end, static_cast<std::streamsize>(room));
    end += static_cast<size_t>(stream.gcount());
    if (stream.bad()) throw InputError("{}: cannot be read ({})", path.string(), std::strerror(errno));
    if (end > limits.*bytes) refuse_size(path, limits, bytes);
    if (end < text.size()) {
      text.resize(end);
      return text;
    }
  }
}

bool lies_within(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const auto followed = [&](const fs::path& name) { return fs::weakly_canonical(fs::absolute(name, error), error); };
  const fs::path inner = followed(path);
  if (error) return false;
  fs::path outer = followed(folder.empty() ? fs::path(".") : folder);
  if (error) return false;
  if (!outer.has_filename()) outer = outer.parent_path();  // "/"
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

void require_writable(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::exists(folder, error)) {
    throw CommandError("{}: its folder '{}' does not exist; create it first", path.string(), folder.string());
  }
  if (!fs::is_directory(folder, error)) {
    throw CommandError("{}: '{}' is not a folder", path.string(), folder.string());
  }
  if (fs::is_directory(path, error)) {
    throw CommandError("{}: is a folder, a file name is expected", path.string());
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw CommandError("{}: folder '{}' cannot be written to ({})", path.string(), folder.string(),
                       std::strerror(errno));
  }
}

void write_whole(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  require_writable(path);
  fs::path temporary = path;
  temporary.replace_filename(
      fmt::format(".{}.{}{}{}", path.stem().string(), ::getpid(), unfinished, path.extension().string()));
  try {
    write(temporary);
    fs::rename(temporary, path);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw MachineError("{}: cannot be written ({})", path.string(), error.code().message());
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void remove_abandoned(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> abandoned;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::optional<int> writer = writer_of(entry.path().filename().string());
    if (writer && ::kill(*writer, 0) != 0 && errno == ESRCH) abandoned.push_back(entry.path());
  }
  for (const fs::path& path : abandoned) fs::remove(path, error);
}

void write_stream(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  write_whole(path, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    write(stream);
    stream.close();
    if (!stream) {
      throw MachineError("{}: cannot be written ({})", path.string(), std::strerror(errno));
    }
  });
}

void write_text(const fs::path& path, const std::string& text) {
  write_stream(path, [&](std::ostream& stream) { stream << text; });
}

}  // namespace omma
