// Lenses that are turned within their camera: yaw_deg, pitch_deg, roll_deg.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <numbers>

#include "omma/base/error.h"
#include "omma/camera/camera.h"
#include "omma/camera/files/camera_file.h"
#include "omma/camera/fit.h"
#include "omma/math/heading.h"

namespace omma {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

glm::dvec3 ray(const Camera& camera, const glm::dvec2& pixel) { return camera.unproject(pixel).value().direction; }

Camera fisheye(const std::string& turned) {
  return make_camera("equidistant:fov_deg=180," + turned, ImageSize{180, 180});
}

TEST(LensRotation, YawIsToTheRightPitchIsUpRollIsClockwise) {
  // 30 pixels from the middle are 30 degrees.
  const double s = std::sin(30 * degree), c = std::cos(30 * degree);
  const glm::dvec2 middle(90, 90), right(120, 90);
  EXPECT_LT(glm::distance(ray(fisheye("yaw_deg=30"), middle), {s, 0, -c}), 1e-15);
  EXPECT_LT(glm::distance(ray(fisheye("yaw_deg=60"), right), {1, 0, 0}), 1e-15);
  EXPECT_LT(glm::distance(ray(fisheye("pitch_deg=30"), middle), {0, s, -c}), 1e-15);
  EXPECT_LT(glm::distance(ray(fisheye("pitch_deg=90"), right), {s, c, 0}), 1e-15);
  EXPECT_LT(glm::distance(ray(fisheye("roll_deg=90"), right), {0, -s, -c}), 1e-15);
  // Roll first, then pitch, then yaw: the way to the right goes down, then ahead of what looks up, then to the right.
  EXPECT_LT(glm::distance(ray(fisheye("yaw_deg=90,pitch_deg=90,roll_deg=90"), middle), {0, 1, 0}), 1e-15);
  EXPECT_LT(glm::distance(ray(fisheye("yaw_deg=90,pitch_deg=90,roll_deg=90"), right), {s, c, 0}), 1e-15);
}

TEST(LensRotation, TurnsWhatIsSeenAndNothingElse) {
  const glm::dmat3 rotation = rotation_of({.yaw = 130 * degree, .pitch = -35 * degree, .roll = 70 * degree});
  size_t count = 0;
  for (const LensModel& model : lens_models()) {
    const std::string text = model.info.example;
    const Camera straight = make_camera(text), turned = make_camera(text + ",yaw_deg=130,pitch_deg=-35,roll_deg=70");
    const glm::dvec2 size(straight.size().width, straight.size().height);
    for (int y = 1; y < 20; ++y) {
      for (int x = 1; x < 20; ++x) {
        const glm::dvec2 pixel = size * glm::dvec2(x, y) / 20.0;
        const auto before = straight.unproject(pixel), after = turned.unproject(pixel);
        ASSERT_EQ(before.has_value(), after.has_value()) << text;
        if (!before) continue;
        ++count;
        EXPECT_LT(glm::distance(rotation * before->direction, after->direction), 1e-15) << text;
      }
    }
  }
  EXPECT_GT(count, lens_models().size() * 200);
}

TEST(LensRotation, ComesBackFromItsText) {
  EXPECT_EQ(to_text(make_camera("perspective:f=50,yaw_deg=30,pitch_deg=-20.5,roll_deg=179", ImageSize{20, 10})),
            "perspective:f=50,cx=10,cy=5,width=20,height=10,yaw_deg=30,pitch_deg=-20.5,roll_deg=179");
  // Straight up, where yaw and roll are one; turns that are the same rotation.
  for (const char* turned : {"pitch_deg=90,yaw_deg=25", "pitch_deg=-90,yaw_deg=25,roll_deg=-200", "pitch_deg=120",
                             "yaw_deg=-360", "yaw_deg=1e-7", "pitch_deg=89.99999999,yaw_deg=77"}) {
    const Camera camera = fisheye(turned), again = make_camera(to_text(camera));
    const glm::dmat3 &a = camera.lens()->cameraFromLens, &b = again.lens()->cameraFromLens;
    for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(a[i], b[i]), 1e-13) << turned;
  }
  EXPECT_THROW(fisheye("yaw_deg=361"), CommandError);
  EXPECT_THROW(fisheye("pitch_deg=nan"), CommandError);
}

TEST(LensRotation, TurnsFormulaeOfAnAngleToo) {
  const Camera lens = fisheye("yaw_deg=40,pitch_deg=50,roll_deg=-60");
  const Camera formula =
      make_camera("expression:r=theta,fov_deg=180,yaw_deg=40,pitch_deg=50,roll_deg=-60", ImageSize{180, 180});
  for (const glm::dvec2& pixel : {glm::dvec2(90.5, 90.5), glm::dvec2(30.5, 120.5), glm::dvec2(150.5, 60.5)}) {
    EXPECT_LT(glm::distance(ray(lens, pixel), ray(formula, pixel)), 1e-7);
  }
}

TEST(LensRotation, IsKeptByAFit) {
  const Camera camera = make_camera("stereographic:fov_deg=150,fit=full,width=400,height=300,yaw_deg=50,pitch_deg=70");
  const CameraFit fit = fit_camera(camera, *find_lens_model("eucm"));
  EXPECT_LT(fit.residual.max_px, 1e-4);
  EXPECT_EQ(fit.camera.lens()->cameraFromLens, camera.lens()->cameraFromLens);
}

TEST(LensRotation, HasNoPlaceInCalibrationFiles) {
  const NamedCamera turned{"cam0", make_camera("perspective:f=500,width=640,height=480,roll_deg=90")};
  const auto path = std::filesystem::temp_directory_path() / "omma_turned_lens.txt";
  for (const char* format : {"opencv", "ros", "kalibr", "basalt", "colmap", "nerfstudio"}) {
    try {
      write_camera_file(path, {&turned, 1}, format);
      ADD_FAILURE() << format;
    } catch (const CommandError& error) {
      EXPECT_NE(std::string(error.what()).find("roll_deg"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

}  // namespace
}  // namespace omma
