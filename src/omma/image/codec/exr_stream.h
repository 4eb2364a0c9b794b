// OpenEXR reads and writes through streams; these lie in memory.
#pragma once

#include <ImfIO.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace omma {

class ExrInput : public Imf::IStream {
 public:
  explicit ExrInput(std::string_view bytes) : Imf::IStream("picture"), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || at_ > bytes_.size() || bytes_.size() - at_ < size_t(count)) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(to, bytes_.data() + at_, size_t(count));
    at_ += size_t(count);
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t at) override { at_ = at; }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
};

class ExrOutput : public Imf::OStream {
 public:
  ExrOutput() : Imf::OStream("picture") {}

  void write(const char from[], int count) override {
    if (at_ + size_t(count) > bytes_.size()) bytes_.resize(at_ + size_t(count));
    std::memcpy(bytes_.data() + at_, from, size_t(count));
    at_ += size_t(count);
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t at) override { at_ = at; }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  size_t at_ = 0;
};

/// How many threads OpenEXR is to use. It has none of its own unless told; a host that has told it keeps what it said.
int exr_threads();

}  // namespace omma
