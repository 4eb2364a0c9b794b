// Files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

namespace omma {

/// The whole file as text. Throws InputError when it is missing, a folder, a pipe, a device, unreadable or larger than
/// 4 GiB.
std::string read_file(const std::filesystem::path& path);

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
