// What the tests of calibration files share.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "omma/base/error.h"
#include "omma/camera/files/camera_file.h"
#include "tests/unit/camera_files_samples.h"

namespace omma {

inline const std::string& sample(const std::string& format, size_t skip = 0) {
  for (const SampleFile& file : sample_files()) {
    if (file.format == format && skip-- == 0) return file.text;
  }
  throw std::runtime_error(format);
}

inline Lens lens_of(const std::string& text, const std::string& name = {}) {
  const CameraFile file = CameraFile::parse("sample", text);
  return *(name.empty() ? file.camera() : file.camera(name)).lens();
}

inline void expect_lens(const Lens& lens, const char* model, ImageSize size, std::vector<double> focal_and_centre,
                        const std::vector<double>& parameters) {
  EXPECT_STREQ(lens.model->info.name, model);
  EXPECT_EQ(lens.size.width, size.width);
  EXPECT_EQ(lens.size.height, size.height);
  const double given[] = {lens.focal.x, lens.focal.y, lens.centre.x, lens.centre.y};
  for (size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(given[i], focal_and_centre[i]) << i;
  for (size_t i = 0; i < parameters.size(); ++i) EXPECT_DOUBLE_EQ(lens.parameters.k[i], parameters[i]) << i;
}

/// Expects an InputError that names the file and every fragment.
inline void expect_input_error(const std::string& text, const std::vector<std::string>& fragments) {
  try {
    const CameraFile file = CameraFile::parse("broken.file", text);
    for (const std::string& name : file.names()) file.camera(name);
    FAIL() << "read: " << text;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("broken.file"), std::string::npos) << message;
    for (const std::string& fragment : fragments) EXPECT_NE(message.find(fragment), std::string::npos) << message;
  }
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

}  // namespace omma
