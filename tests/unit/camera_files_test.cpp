// Calibration files: the conventions of each program, real files, round trips, and files that are broken.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/camera/field_of_view.h"
#include "omma/camera/files/camera_file.h"
#include "omma/camera/files/format.h"
#include "tests/places.h"
#include "tests/unit/camera_files_expect.h"

namespace omma {
namespace {

TEST(CameraFiles, EverySampleIsRecognisedAsItsOwnFormatAndEveryFormatHasOne) {
  std::set<std::string> seen;
  for (const SampleFile& sample : sample_files()) {
    const CameraFile file = CameraFile::parse("sample", sample.text);
    EXPECT_STREQ(file.format(), sample.format);
    for (const std::string& name : file.names()) EXPECT_GT(file.camera(name).pixels_per_radian(), 0.0);
    seen.insert(sample.format);
  }
  for (const CameraFormat* format : camera_formats()) EXPECT_TRUE(seen.contains(format->name)) << format->name;
}

TEST(CameraFiles, OpenCvCountsFromTheFirstPixelsCentreAndPutsTangentialBeforeK3) {
  expect_lens(lens_of(sample("opencv")), "opencv", {640, 480},
              {535.91573396163199, 535.91573396163199, 342.28315473308373 + 0.5, 235.57082909788173 + 0.5},
              {-0.26637260909660682, -0.038588898922304653, 0.0017831947042852964, -0.00028122100441115472,
               0.23839153080878486, 0.0});
  expect_lens(lens_of(sample("opencv", 1)), "mei", {640, 480}, {400, 410, 320, 240}, {1.25, -0.1, 0.02, 1e-3, -2e-3});
}

TEST(CameraFiles, FourCoefficientsOfOpenCvAreNotGuessed) {
  std::string text = replaced(sample("opencv"), "rows: 5", "rows: 4");
  text = replaced(text, ",\n       -2.8122100441115472e-04, 2.3839153080878486e-01", ", -2.8e-04");
  expect_lens(lens_of(text), "opencv", {640, 480},
              {535.91573396163199, 535.91573396163199, 342.78315473308373, 236.07082909788173}, {-0.26637260909660682});
  EXPECT_STREQ(lens_of(replaced(text, "fisheye_model: 0", "fisheye_model: 1")).model->info.name, "opencv_fisheye");
  expect_input_error(replaced(text, "fisheye_model: 0\n", ""), {"distortion_coefficients", "fisheye_model"});
}

TEST(CameraFiles, RosKalibrAndCamodocalHaveTheirOrders) {
  expect_lens(lens_of(sample("ros")), "opencv", {640, 480}, {430.15, 430.53, 307.19, 227.72},
              {-0.3375, 0.1117, -0.0011, -0.0002, 0.003});
  expect_lens(lens_of(sample("kalibr"), "cam0"), "mei", {640, 480}, {800.5, 801.5, 320.75, 241.25},
              {1.5, -0.2, 0.05, 0.001, -0.002});
  expect_lens(lens_of(sample("kalibr"), "cam1"), "double_sphere", {512, 512}, {158.25, 158.5, 255.25, 257.0},
              {-0.17, 0.59});
  expect_lens(lens_of(sample("camodocal")), "opencv_fisheye", {752, 480}, {461.5, 460.25, 367, 250},
              {-0.01, 0.02, -0.003, 0.0004});
}

TEST(CameraFiles, BasaltColmapAndNerfstudioHaveTheirOrders) {
  expect_lens(lens_of(sample("basalt")), "eucm", {512, 512}, {380.5, 381.5, 255, 256.75}, {0.61, 1.0});
  expect_lens(lens_of(sample("colmap"), "1"), "opencv", {3072, 2304}, {2559.81, 2559.81, 1536, 1152},
              {-0.0204997, 0.0});
  expect_lens(lens_of(sample("colmap"), "2"), "opencv", {640, 480}, {500.5, 501.5, 320.25, 240.75},
              {0.1, -0.2, 0.001, -0.002, 0.03, 0.11, -0.21, 0.031});
  expect_lens(lens_of(sample("colmap"), "3"), "eucm", {512, 512}, {191.25, 191.5, 255.5, 257.25}, {0.63, 1.04});
  expect_lens(lens_of(sample("nerfstudio")), "opencv_fisheye", {640, 480}, {293.5, 294.5, 320.25, 240.5},
              {0.05, -0.01, 0.002, -0.0003});
}

TEST(CameraFiles, OcamCalibWritesRowsBeforeColumns) {
  const Lens lens = lens_of(sample("ocamcalib"));
  expect_lens(lens, "ocam", {1600, 1590}, {1, 1, 799, 794.75},
              {-471.4441, 0, 7.356108e-04, -3.773045e-07, 5.800006e-10, 0, 0, 1.000305, -0.000277, -0.000925});
  // cam2world of the toolbox's C code, 200 rows below the centre: x, y = row, column of the affine's inverse.
  const double c = 1.000305, d = -0.000277, e = -0.000925, scale = 1 / (c - d * e);
  const double row = scale * 200, column = scale * -e * 200, r = std::hypot(row, column);
  const double z = -471.4441 + r * r * (7.356108e-04 + r * (-3.773045e-07 + r * 5.800006e-10));
  const auto ray = lens.unproject(lens.centre + glm::dvec2(0, 200));
  ASSERT_TRUE(ray);
  const glm::dvec3 expected = glm::normalize(glm::dvec3(column, -row, z));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR((*ray)[i], expected[i], 1e-12);
}

TEST(CameraFiles, PolynomialsRunAsTheFileSays) {
  const Lens forward = lens_of(sample("nvidia"));
  expect_lens(forward, "ftheta", {3840, 2160}, {1, 1, 1920, 1080},
              {1888.5, -41.5, 11.5, -18.25, 6.5, 0.9996, 3.4e-06, 3.7e-05, 0});
  EXPECT_DOUBLE_EQ(forward.parameters.max_angle, 1.25);
  const std::string text = replaced(sample("nvidia"), "\"reference_poly\": \"2\"", "\"reference_poly\": \"1\"");
  expect_lens(lens_of(text), "ftheta", {3840, 2160}, {1, 1, 1920, 1080},
              {0.0005, 0, 0, 0, 0, 0.9996, 3.4e-06, 3.7e-05, 1});

  // Degrees, the whole field, from the distance to the angle: 100 pixels from the centre are 0.245 radians.
  const Lens usd = lens_of(sample("usd"));
  EXPECT_NEAR(usd.parameters.max_angle, 100.0 * 3.14159265358979 / 180.0, 1e-12);
  const auto ray = usd.unproject(glm::dvec2(970.9424 + 100, 600.375));
  ASSERT_TRUE(ray);
  EXPECT_NEAR(std::atan2(ray->x, -ray->z), 0.245, 1e-12);
  // All powers, from the angle to the distance.
  const Lens woodscape = lens_of(sample("woodscape"));
  const auto pixel = woodscape.project({std::sin(0.8), 0, -std::cos(0.8)});
  ASSERT_TRUE(pixel);
  const double rho = 0.8 * (339.749 + 0.8 * (-31.988 + 0.8 * (48.275 + 0.8 * -7.201)));
  EXPECT_NEAR(pixel->x, 643.942 + rho, 1e-9);
  EXPECT_NEAR(pixel->y, 483.0 - 3.093, 1e-9);
}

TEST(CameraFiles, StellaMaplabAndSdf) {
  expect_lens(lens_of(sample("stella")), "opencv_fisheye", {960, 540}, {441.75, 442.5, 480.75, 276},
              {-0.03, -0.003, -0.002, -0.0005});
  expect_lens(lens_of(sample("maplab")), "fov", {1440, 1080}, {701.5, 701.25, 704, 530.75}, {0.93});
  const Lens sdf = lens_of(sample("sdf"));
  expect_lens(sdf, "custom_radial", {800, 600}, {sdf.focal.x, sdf.focal.x, 400, 300}, {1.05, 4, 0, 0});
  EXPECT_DOUBLE_EQ(sdf.parameters.max_angle, 1.5707);
  // scale_to_hfov: half of the field, 90 degrees, lies at the edge, 400 pixels from the middle.
  EXPECT_NEAR(sdf.focal.x * 1.05 * std::tan(3.14159265 / 8), 400.0, 1e-9);
}

TEST(CameraFiles, MistakesAreNamedWithFileLineAndKey) {
  expect_input_error(replaced(sample("kalibr"), "camera_model: omni", "camera_model: omnii"),
                     {":2", "cam0.camera_model", "omni'"});
  expect_input_error(replaced(sample("kalibr"), "[-0.2, 0.05, 0.001, -0.002]", "[-0.2, 0.05, 0.001]"),
                     {":3", "cam0.distortion_coeffs", "3 numbers"});
  expect_input_error(replaced(sample("kalibr"), "320.25, 240.75", "32025, 240.75"), {"principal point", "640 x 480"});
  expect_input_error(replaced(sample("kalibr"), "resolution", "resolutoin"), {"resolution", "resolutoin"});
  expect_input_error(replaced(sample("basalt"), "\"alpha\": 0.61", "\"alpha\": 1.61"), {"alpha", "0 to 1"});
  expect_input_error(replaced(sample("basalt"), "0.61", "\"0.61\""), {"alpha", "quotes"});
  expect_input_error(replaced(sample("colmap"), "SIMPLE_RADIAL", "SIMPLE_RADIALL"), {":2", "SIMPLE_RADIAL"});
  expect_input_error(replaced(sample("colmap"), " -0.0204997", ""), {":2", "parameters"});
  expect_input_error(replaced(sample("ros"), "plumb_bob", "equidistant"), {"distortion_coefficients", "5 numbers"});
  expect_input_error(replaced(sample("ros"), "430.53, 227.22", "430.53, .nan"), {"camera_matrix", "number"});
  expect_input_error(replaced(sample("nvidia"), "null", "{\"type\": \"bivariate-windshield\"}"), {"windshield"});
  expect_input_error(replaced(sample("nerfstudio"), "\"fl_x\"", "\"w\""), {"twice"});
  expect_input_error(replaced(sample("stella"), "k1: -0.03", "k1: [-0.03]"), {"Camera.k1", "number"});
  expect_input_error(replaced(sample("sdf"), "<type>custom", "<type>costum"), {"custom"});
  expect_input_error("cam0: &a {camera_model: ds}\ncam1: *a\n", {"anchor", ":2"});
  expect_input_error("hello: world\n", {"kalibr", "colmap"});
  expect_input_error("", {"nothing"});
  expect_input_error(std::string(1 << 16, '['), {"deep"});
}

TEST(CameraFiles, WhatCouldBeSeveralFormatsIsRefusedWithTheirNames) {
  expect_input_error(sample("stella") + sample("kalibr"), {"stella", "kalibr"});
}

TEST(CameraFiles, SeveralCamerasMustBeChosenFrom) {
  const CameraFile file = CameraFile::parse("rig.yaml", sample("kalibr"));
  EXPECT_THROW(
      {
        try {
          file.camera();
        } catch (const CommandError& error) {
          EXPECT_NE(std::string(error.what()).find("rig.yaml#cam0"), std::string::npos);
          throw;
        }
      },
      CommandError);
  EXPECT_THROW(file.camera("cam2"), CommandError);
}

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / fmt::format("omma_files_{}_{}", info->name(), ::getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

using CameraFileFolder = Folder;

TEST_F(CameraFileFolder, WhatIsWrittenIsReadAsTheSameCamera) {
  std::vector<NamedCamera> cameras;
  for (const SampleFile& sample : sample_files()) {
    const CameraFile file = CameraFile::parse("sample", sample.text);
    for (const std::string& name : file.names()) {
      const Camera camera = file.camera(name);
      if (camera.lens()) cameras.push_back({name, camera});
    }
  }
  for (const LensModel& model : lens_models()) cameras.push_back({model.info.name, make_camera(model.info.example)});
  cameras.push_back({"panorama", make_camera("equirectangular:width=2000,height=1000")});
  std::map<std::string, int> written;
  for (const CameraFormat* format : camera_formats()) {
    if (!format->write || format == &pieces_format) continue;
    for (const NamedCamera& camera : cameras) {
      // The formats that are written hold no angle at which a lens ends but its own.
      Lens lens = *camera.camera.lens();
      lens.parameters.max_angle = lens.model->info.max_angle(lens.parameters);
      const NamedCamera whole{camera.name, Camera(lens)};
      const std::filesystem::path path = folder_ / (std::string("camera") + format->extension);
      try {
        write_camera_file(path, {&whole, 1}, format->name);
      } catch (const CommandError& error) {
        EXPECT_NE(std::string(error.what()).find("--model"), std::string::npos) << error.what();
        continue;
      }
      const CameraFile file = CameraFile::load(path);
      EXPECT_STREQ(file.format(), format->name);
      const Camera read = file.camera();
      size_t points = 0;
      for (int i = 0; i <= 10; ++i) {
        for (int j = 0; j <= 10; ++j) {
          const glm::dvec2 pixel(lens.size.width * i / 10.0, lens.size.height * j / 10.0);
          const auto ray = whole.camera.unproject(pixel);
          const auto again = ray ? read.project(ray->direction) : std::nullopt;
          if (!ray || !whole.camera.project(ray->direction)) continue;
          ASSERT_TRUE(again) << format->name << " " << camera.name;
          EXPECT_LT(glm::distance(*again, *whole.camera.project(ray->direction)), 1e-9)
              << format->name << " " << camera.name;
          ++points;
        }
      }
      EXPECT_GT(points, 8u) << format->name << " " << camera.name;
      ++written[format->name];
    }
  }
  // Every format that is written took some of them.
  EXPECT_EQ(written.size(), 6u);
  for (const auto& [name, count] : written) EXPECT_GE(count, 8) << name;
}

TEST_F(CameraFileFolder, SeveralCamerasGoIntoOneFile) {
  const CameraFile rig = CameraFile::parse("rig", sample("kalibr"));
  const std::vector<NamedCamera> cameras = {{"a", rig.camera("cam0")}, {"b", rig.camera("cam1")}};
  write_camera_file(folder_ / "rig.yaml", cameras, "kalibr");
  const CameraFile read = CameraFile::load(folder_ / "rig.yaml");
  EXPECT_EQ(read.names(), (std::vector<std::string>{"cam0", "cam1"}));
  EXPECT_EQ(read.camera("cam1"), rig.camera("cam1"));
  EXPECT_THROW(write_camera_file(folder_ / "rig.yaml", cameras, "opencv"), CommandError);
  EXPECT_THROW(write_camera_file(folder_ / "rig.yaml", cameras), CommandError);
}

TEST_F(CameraFileFolder, MakeCameraTakesAFileAndOneOfItsCameras) {
  const std::string path = (folder_ / "rig.yaml").string();
  write_text(path, sample("kalibr"));
  const Camera camera = make_camera(path + "#cam1");
  EXPECT_EQ(camera.size(), (ImageSize{512, 512}));
  const Camera half = make_camera(path + "#cam1", ImageSize{256, 256});
  EXPECT_DOUBLE_EQ(half.lens()->focal.x, 0.5 * 158.25);
  EXPECT_DOUBLE_EQ(half.lens()->centre.x, 0.5 * 255.25);
  EXPECT_THROW(make_camera(path), CommandError);
  EXPECT_THROW(make_camera(path + "#cam7"), CommandError);
  EXPECT_THROW(make_camera(path + "#cam1", ImageSize{256, 100}), CommandError);
  EXPECT_THROW(make_camera((folder_ / "none.yaml").string()), InputError);
}

TEST(CameraFiles, RealFilesAreRead) {
  const std::filesystem::path folder = std::filesystem::path(places::shared_data) / "calib";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  int files = 0, cameras = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const CameraFile file = CameraFile::load(entry.path());
    ++files;
    for (const std::string& name : file.names()) {
      if (name == "camera_left_fisheye_mild") {
        EXPECT_THROW(file.camera(name), InputError);  // behind a windshield
        continue;
      }
      const FieldOfView fov = field_of_view(file.camera(name));
      ASSERT_TRUE(fov.horizontal_deg) << entry.path() << " " << name;
      EXPECT_GT(*fov.horizontal_deg, 25.0) << entry.path() << " " << name;
      EXPECT_LT(*fov.horizontal_deg, 230.0) << entry.path() << " " << name;
      ++cameras;
    }
  }
  EXPECT_GE(files, 12);
  EXPECT_GE(cameras, 20);
}

// Reads what can be read; anything but a camera, or an error that names the file, fails. Says whether there was a
// camera.
bool survives(const std::string& text) {
  bool any = false;
  try {
    const CameraFile file = CameraFile::parse("broken.file", text);
    for (const std::string& name : file.names()) {
      try {
        const Camera camera = file.camera(name);
        EXPECT_GT(camera.pixels_per_radian(), 0.0) << text;
        any = true;
      } catch (const InputError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("broken.file")) << error.what();
      }
    }
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("broken.file")) << error.what();
  }
  return any;
}

TEST(CameraFiles, BrokenFilesGiveACameraOrAnErrorThatNamesThem) {
  size_t texts = 0, cameras = 0;
  const auto check = [&](const std::string& text) {
    ++texts;
    cameras += survives(text);
  };
  for (const SampleFile& sample : sample_files()) {
    const std::string& text = sample.text;
    for (size_t end = 0; end < text.size(); end += 7) check(text.substr(0, end));
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
      const std::string line = text.substr(begin, end - begin);
      check(text.substr(0, begin) + text.substr(end));
      check(text.substr(0, end) + line + text.substr(end));
      begin = end;
    }
    for (size_t at = 0; at < text.size(); ++at) {
      const bool digit = text[at] >= '0' && text[at] <= '9';
      if (!digit || (at > 0 && text[at - 1] >= '0' && text[at - 1] <= '9')) continue;
      size_t end = at;
      while (end < text.size() && ((text[end] >= '0' && text[end] <= '9') || text[end] == '.')) ++end;
      for (const char* value : {"nan", "-1e308", "1e999", "\"x\"", "[[[]]]", "{}", "", "0"}) {
        check(text.substr(0, at) + value + text.substr(end));
      }
    }
  }
  EXPECT_GT(texts, 4000u);
  // Some of the changes leave a sound file.
  EXPECT_GT(cameras, texts / 50);
}

TEST(CameraFiles, TheDocumentationHoldsTheTable) {
  EXPECT_NE(read_file(std::filesystem::path(places::source) / "docs/camera-files.md").find(camera_format_table()),
            std::string::npos)
      << "docs/camera-files.md should hold:\n"
      << camera_format_table();
}

}  // namespace
}  // namespace omma
