// Writes the sample files of the unit tests into a folder, for the fuzz targets to start from.
#include <filesystem>

#include "omma/base/file.h"
#include "tests/unit/camera_files_samples.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  int number = 0;
  for (const omma::SampleFile& sample : omma::sample_files()) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / sample.format;
    std::filesystem::create_directories(folder);
    omma::write_text(folder / std::to_string(number++), sample.text);
  }
}
