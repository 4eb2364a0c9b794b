// Writes a folder of sample files for each fuzz target to start from.
#include <filesystem>
#include <string>
#include <utility>

#include "omma/base/file.h"
#include "omma/image/npy.h"
#include "omma/image/pfm.h"
#include "tests/unit/camera_files_samples.h"

namespace {

using omma::FloatImage;

// A picture of places in the image, moved and scaled.
FloatImage places(float scale, float shift) {
  FloatImage image({5, 4}, 3);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      float* value = image.at(x, y);
      value[0] = scale * (static_cast<float>(x) + 0.5F) / 5.0F + shift;
      value[1] = scale * (static_cast<float>(y) + 0.5F) / 4.0F + shift;
      value[2] = 1.0F;
    }
  }
  return image;
}

const std::pair<const char*, const char*> texts[] = {
    {"warp_data", "2\n2 3\n-1.3 -1 0 0 1\n1.3 -1 1 0 1\n-1.3 0 0 .4 1\n1.3 0.1 1 .5 -1\n-1.3 1 0 1 1\n1.3 1 1 1 1\n"},
    {"warp_data", "1\n3 2\n0 0 .5 .5 1\n.1 0 .5 .5 1\n0 .1 .5 .5 1\n1 0 1 .5 1\n-.5 .8 .2 .9 1\n-.5 -.8 .2 .1 1\n"},
    {"warp_obj",
     "# a quad and a triangle\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
     "f 1/1 2/2 3/3 4/4\nf -4 2//1 -2/3\n"},
    {"expression", "# by its formula\nr = 2*sin(theta/2)\nfov_deg = 180\n"},
    {"expression", "theta = if(r<0.5, r, atan2(r, 1) + 0.04)\nf = 20\nyaw_deg = 10\n"},
    {"expression", "longitude = pi*u\nlatitude = pi/2*v\nwidth = 40\nheight = 30\n"},
    {"expression", "x = sin(u)*aspect\ny = -v^3\nz = -max(0.1, 1-abs(u*v))\n"},
    {"table", "# angle radius\n0 0\n30.5 0.5\n60, 0.9\n95; 1.2e0\n"},
    {"table", "0 0\n10 20\n20 37\n"},
    {"poses", "# time tx ty tz qx qy qz qw\n1.5 1 2 3 0 0 0 1\n2.5 1.5 2 3 0 0.6 0 0.8\n"},
    {"poses", "1 1 0 0 0 0.5 -1 2 1 a b.png\n100 200.5 -1 3 4 17\n2 0.6 0.8 0 0 1 2 3 1 c.png\n\n"},
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  int number = 0;
  const auto place = [&](const std::string& target, const char* extension) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / target;
    std::filesystem::create_directories(folder);
    return folder / (std::to_string(number++) + extension);
  };
  for (const omma::SampleFile& sample : omma::sample_files()) omma::write_text(place(sample.format, ""), sample.text);
  for (const auto& [target, text] : texts) omma::write_text(place(target, ""), text);
  omma::write_pfm(place("camera_texture", ".pfm"), places(0.1F, -0.05F));
  omma::write_pfm(place("warp_pfm", ".pfm"), places(1.0F, 0.0F));
  constexpr size_t shape[] = {4, 5, 3};
  omma::write_npy<float>(place("camera_texture_npy", ".npy"), shape, places(0.1F, -0.05F).values);
  omma::write_npy<float>(place("ray_map", ".npy"), shape, places(1.0F, -0.5F).values);
}
