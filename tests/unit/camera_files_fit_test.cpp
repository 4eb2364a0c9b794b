// Cameras as other models.
#include <gtest/gtest.h>

#include "omma/base/error.h"
#include "omma/camera/fit.h"

namespace omma {
namespace {

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

TEST(CameraFit, WhatAModelCannotSeeIsCounted) {
  const CameraFit fit =
      fit_camera(make_camera("equidistant:fov_deg=220,fit=full,width=400,height=400"), *find_lens_model("perspective"));
  EXPECT_GT(fit.residual.lost, 1000u);
}

}  // namespace
}  // namespace omma
