// Files that are read whole, and that are there whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

#include "omma/base/limits.h"

namespace omma {

/// Throws InputError when there is no file of this name, when it is a folder, a pipe or a device, and when it is larger
/// than a limit of bytes. Whoever lets a library open a file asks this first.
void require_readable(const std::filesystem::path& path, const Limits& limits = {},
                      size_t Limits::*bytes = &Limits::file_bytes);

/// The whole file as text. Throws InputError as require_readable does, and when it cannot be read.
std::string read_file(const std::filesystem::path& path, const Limits& limits = {},
                      size_t Limits::*bytes = &Limits::file_bytes);

/// Whether `path` lies within `folder` once links and `..` are followed. What does not exist is taken by its name.
bool lies_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Throws CommandError when `path` could not be created: its folder is missing, or is no folder.
void require_writable(const std::filesystem::path& path);

/// Calls `write` with a temporary path beside `path` (same extension), then renames it into place.
/// When `write` throws, the temporary file is removed and `path` is as it was. Throws CommandError
/// when the folder is missing, MachineError when the disk refuses.
void write_whole(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path& temporary)>& write);

/// Removes the temporary files in `folder` that write_whole left behind when its process was killed.
void remove_abandoned(const std::filesystem::path& folder);

/// write_whole through a binary stream; MachineError when the stream fails.
void write_stream(const std::filesystem::path& path, const std::function<void(std::ostream& stream)>& write);

/// write_whole of a text.
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace omma
