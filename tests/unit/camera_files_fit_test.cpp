// Cameras as other models.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "omma/base/error.h"
#include "omma/camera/fit.h"

namespace omma {
namespace {

constexpr double radians(double deg) { return deg * 3.14159265358979323846 / 180.0; }

constexpr const char* fisheye =
    "opencv_fisheye:fx=190.97,fy=190.98,cx=255.4,cy=257.4,width=512,height=512,k1=0.0035,k2=0.0007,k3=-0.0021,k4=0."
    "0002";

TEST(CameraFit, TheSameModelIsTheSameCamera) {
  const Camera camera = make_camera(fisheye);
  const CameraFit fit = fit_camera(camera, *find_lens_model("kb4"));
  EXPECT_EQ(fit.camera, camera);
  EXPECT_LT(fit.residual.max_px, 1e-9);
  EXPECT_GT(fit.residual.points, 30000u);
  EXPECT_EQ(fit.residual.lost, 0u);
}

TEST(CameraFit, FindsAModelThatHoldsTheCameraExactly) {
  // Equisolid is the unified model with xi = 1 seen from within, and stereographic is alpha = 1/2.
  for (const char* text :
       {"stereographic:fov_deg=170,fit=full,width=800,height=600",
        "equidistant:fov_deg=170,fit=full,width=800,height=600", "perspective:fov_deg=100,width=800,height=600"}) {
    const Camera camera = make_camera(text);
    for (const char* model : {"eucm", "opencv_fisheye", "opencv"}) {
      const bool exact = (std::string(model) == "eucm" && text[0] != 'e') ||
                         (std::string(model) == "opencv_fisheye" && text[0] == 'e') ||
                         (std::string(model) == "opencv" && text[0] == 'p');
      if (!exact) continue;
      const CameraFit fit = fit_camera(camera, *find_lens_model(model));
      EXPECT_LT(fit.residual.max_px, 1e-4) << text << " as " << model;
      EXPECT_EQ(fit.residual.lost, 0u) << text << " as " << model;
    }
  }
}

TEST(CameraFit, AFisheyeAsDoubleSphereIsNearAndSaysHowNear) {
  const Camera camera = make_camera(fisheye);
  const CameraFit fit = fit_camera(camera, *find_lens_model("double_sphere"));
  EXPECT_LT(fit.residual.mean_px, 0.5);
  EXPECT_LE(fit.residual.mean_px, fit.residual.max_px);
  EXPECT_LE(fit.residual.p95_px, fit.residual.max_px);
  EXPECT_GT(fit.residual.max_px, 1e-6);
  // What is said is what is: the worst pixel is that far off.
  const auto ray = camera.unproject(fit.residual.max_at);
  ASSERT_TRUE(ray);
  EXPECT_NEAR(glm::distance(*fit.camera.project(ray->direction), fit.residual.max_at), fit.residual.max_px, 1e-12);
}

TEST(CameraFit, OnlyTheNamedParametersAreFitted) {
  const Camera camera = make_camera("opencv:f=500,width=640,height=480,k1=-0.2,k2=0.05,k3=0.01");
  const CameraFit fit = fit_camera(camera, *find_lens_model("opencv"), std::vector<std::string>{"k1", "k2"});
  EXPECT_EQ(fit.camera.lens()->parameters.k[4], 0.0);
  EXPECT_LT(fit.residual.max_px, 0.2);  // 0.17 in the corners: what k3 was good for
  EXPECT_THROW(fit_camera(camera, *find_lens_model("opencv"), std::vector<std::string>{"k9"}), CommandError);
}

TEST(CameraFit, WhatAModelCannotSeeIsLeftOutAndDoesNotSpoilTheRest) {
  const Camera wide = make_camera("equidistant:fov_deg=220,fit=full,width=400,height=400");
  const CameraFit flat = fit_camera(wide, *find_lens_model("perspective"));
  // Half of the field could be drawn, but not in an image like this one.
  EXPECT_GT(flat.angle, radians(45));
  EXPECT_LT(flat.angle, radians(70));
  EXPECT_GT(flat.part, 0.2);
  EXPECT_LT(flat.part, 0.6);
  EXPECT_EQ(flat.residual.lost, 0u);
  EXPECT_LT(flat.residual.max_px, 0.05 * std::hypot(400, 400) + 1.0);
  // Whatever is left out is counted where the whole is compared.
  EXPECT_GT(residual_between(wide, flat.camera).lost, 1000u);
  // A pinhole with distortion draws nearly all that lies ahead.
  const CameraFit bent = fit_camera(wide, *find_lens_model("opencv"), std::vector<std::string>{"k1", "k2", "k4", "k5"});
  EXPECT_GT(bent.angle, radians(75));
  EXPECT_LT(bent.residual.mean_px, 1.0);
}

TEST(CameraFit, DoubleSphereIsAtLeastAsNearAsBasaltsOwn) {
  // Basalt's calibrations of one camera (TUM-VI, cam0, 512 x 512), as kb4 and as ds.
  const Camera kb4 = make_camera(
      "kb4:fx=190.97847715128717,fy=190.9733070521226,cx=255.43170605935475,cy=257.3974428996504,width=512,height=512,"
      "k1=0.0034823894022493434,k2=0.0007150348452162257,k3=-0.0020532361418706202,k4=0.00020293673591811182");
  const LensModel& model = *find_lens_model("double_sphere");
  const Residual own = residual_between(kb4, make_camera(model.info.example), radians(85));
  const CameraFit fit = fit_camera(kb4, model);
  EXPECT_EQ(fit.part, 1.0);
  EXPECT_LT(residual_between(kb4, fit.camera, radians(85)).mean_px, own.mean_px);
  std::cout << own.mean_px << " px of Basalt's own, " << fit.residual.mean_px << " px of the fit\n";
}

}  // namespace
}  // namespace omma
