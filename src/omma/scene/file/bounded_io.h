// Files for assimp: those that the scene may name, and with an end, for its line reader reads a PLY whose header is cut
// off over and over again.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/scene/file/reach.h"

namespace omma::file {

/// A file that may be read some hundred times over, plus what the search for the right reader takes; then it throws,
/// and assimp passes the message on. A call costs something too, or reading nothing could go on for ever.
class BoundedStream : public Assimp::IOStream {
 public:
  BoundedStream(Assimp::IOSystem& files, Assimp::IOStream* stream)
      : files_(files), stream_(stream), budget_(2 * call_cost * stream->FileSize() + (size_t{1} << 20)) {}
  ~BoundedStream() override { files_.Close(stream_); }

  size_t Read(void* buffer, size_t size, size_t count) override {
    const size_t wanted = size * count + call_cost;
    if (wanted > budget_) throw std::runtime_error("it ends too early, or its parts contradict each other");
    const size_t read = stream_->Read(buffer, size, count);
    budget_ -= size * read + call_cost;
    return read;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override { return stream_->Seek(offset, origin); }
  size_t Tell() const override { return stream_->Tell(); }
  size_t FileSize() const override { return stream_->FileSize(); }
  void Flush() override {}

 private:
  static constexpr size_t call_cost = 256;  // bytes
  Assimp::IOSystem& files_;
  Assimp::IOStream* stream_;
  size_t budget_;
};

class BoundedFiles : public Assimp::DefaultIOSystem {
 public:
  BoundedFiles(std::string scene, Reach reach, const Limits& limits)
      : scene_(std::move(scene)), reach_(std::move(reach)), limits_(limits) {}

  // assimp's own opens the file, and would wait at a pipe.
  bool Exists(const char* path) const override {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored) && readable(path);
  }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (!Exists(path)) return nullptr;
    Assimp::IOStream* stream = DefaultIOSystem::Open(path, mode);
    return stream ? new BoundedStream(plain_, stream) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

  /// What is there and was not opened, each with its reason.
  const std::vector<std::string>& refusals() const { return refusals_; }

 private:
  bool readable(const std::string& path) const {
    try {
      // The scene's own name is the user's.
      if (path != scene_ && !reach_.holds(path)) throw InputError("{}: {}", path, reach_.why_not());
      require_readable(path, limits_);
      return true;
    } catch (const InputError& error) {
      if (std::ranges::find(refusals_, error.what()) == refusals_.end()) refusals_.emplace_back(error.what());
      return false;
    }
  }

  std::string scene_;
  Reach reach_;
  Limits limits_;
  mutable std::vector<std::string> refusals_;
  Assimp::DefaultIOSystem plain_;
};

}  // namespace omma::file
