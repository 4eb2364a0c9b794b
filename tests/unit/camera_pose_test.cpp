// Trajectories in the formats of TUM and COLMAP.
#include "omma/camera/pose_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "omma/base/error.h"
#include "omma/base/file.h"

namespace omma {
namespace {

class PoseFile : public testing::Test {
 protected:
  ~PoseFile() override { std::filesystem::remove(path_); }

  std::vector<NamedPose> load(const std::string& text) {
    write_text(path_, text);
    return load_poses(path_);
  }

  // The message of the InputError that loading throws.
  std::string error(const std::string& text) {
    try {
      load(text);
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(path_.string()), std::string::npos) << e.what();
      return e.what();
    }
    return "no InputError";
  }

  std::filesystem::path path_ = std::filesystem::temp_directory_path() / fmt::format("omma_poses_{}.txt", ::getpid());
};

void expect_near(const glm::dvec4& a, const glm::dvec4& b) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

TEST_F(PoseFile, ReadsTum) {
  const auto poses =
      load("# time x y z qx qy qz qw\n1.5 1 2 3 0 0 0 1\n\n2.5 4 5 6 0 0.7071067811865476 0 0.7071067811865476\r\n");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].name, "1.5");
  EXPECT_EQ(poses[0].time, 1.5);
  // The optical frame is the world's: the camera's -z is the world's +z and its +y the world's -y.
  expect_near(poses[0].worldFromCamera * glm::dvec4(0, 0, -1, 0), {0, 0, 1, 0});
  expect_near(poses[0].worldFromCamera * glm::dvec4(0, 1, 0, 0), {0, -1, 0, 0});
  expect_near(poses[0].worldFromCamera * glm::dvec4(1, 0, 0, 0), {1, 0, 0, 0});
  expect_near(poses[0].worldFromCamera * glm::dvec4(0, 0, 0, 1), {1, 2, 3, 1});
  // A quarter turn about y takes z to x.
  expect_near(poses[1].worldFromCamera * glm::dvec4(0, 0, -1, 0), {1, 0, 0, 0});
  expect_near(poses[1].worldFromCamera * glm::dvec4(0, 0, 0, 1), {4, 5, 6, 1});
}

TEST_F(PoseFile, ReadsColmap) {
  const auto poses = load(
      "# Image list with two lines of data per image:\n"
      "1 0.7071067811865476 0 0.7071067811865476 0 1 2 3 1 first image.jpg\n"
      "10.5 20.5 -1 30 40 17\n"
      "2 1 0 0 0 0 0 0 1 second.jpg\n"
      "\n"
      "3 1 0 0 0 0 0 -5 1 third.jpg\n");
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].name, "first image.jpg");
  EXPECT_FALSE(poses[0].time);
  // opticalFromWorld turns z to x and adds (1, 2, 3): the world point that it takes to 0 is the camera.
  expect_near(poses[0].worldFromCamera * glm::dvec4(0, 0, 0, 1), {3, -2, -1, 1});
  // Optical z is the world's -x: turned, the world's -x becomes +z.
  expect_near(poses[0].worldFromCamera * glm::dvec4(0, 0, -1, 0), {-1, 0, 0, 0});
  expect_near(poses[1].worldFromCamera * glm::dvec4(0, 1, 0, 0), {0, -1, 0, 0});
  expect_near(poses[2].worldFromCamera * glm::dvec4(0, 0, 0, 1), {0, 0, 5, 1});
}

TEST_F(PoseFile, GivesRigidTransforms) {
  for (const NamedPose& pose : load("0 1 2 3 0.182 0.365 0.548 0.730\n1 1 2 3 -0.5 0.5 0.5 -0.5\n")) {
    const glm::dmat3 rotation(pose.worldFromCamera);
    const glm::dmat3 identity = glm::transpose(rotation) * rotation;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(identity[i][j], i == j ? 1.0 : 0.0, 1e-14);
    }
    EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-14);
  }
}

TEST_F(PoseFile, SaysWhereItIsWrong) {
  EXPECT_NE(error("").find("holds no pose"), std::string::npos);
  EXPECT_NE(error("# only a comment\n\n").find("holds no pose"), std::string::npos);
  EXPECT_NE(error("1 2 3\n").find(".txt:1: 3 fields"), std::string::npos);
  EXPECT_NE(error("0 0 0 0 0 0 0 1\n# c\n1 0 0 0 0 0 1\n").find(".txt:3: 7 fields"), std::string::npos);
  EXPECT_NE(error("0 0 x 0 0 0 0 1\n").find(".txt:1: field 3 is 'x'"), std::string::npos);
  EXPECT_NE(error("0 nan 0 0 0 0 0 1\n").find("field 2 is 'nan'"), std::string::npos);
  EXPECT_NE(error("0 0 0 0 0 0 0 2\n").find("the quaternion has length 2"), std::string::npos);
  EXPECT_NE(error("0 0 0 0 0 0 0 0\n").find("the quaternion has length 0"), std::string::npos);
  EXPECT_NE(error("1 1 0 0 0 0 0 0 1 a.jpg\n2 1 0 0 0 0 0 0 1 b.jpg\n").find(".txt:2: the points"), std::string::npos);
  EXPECT_NE(error(std::string("\x00\xff\x80garbage", 10)).find(".txt:1: "), std::string::npos);
  EXPECT_THROW(load_poses("/nonexistent/poses.txt"), InputError);
}

}  // namespace
}  // namespace omma
