// Cameras of formulae and tables: against the lenses they must equal, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "omma/camera/deformation/expression.h"
#include "omma/camera/deformation/rising_function.h"
#include "tests/unit/camera_deformation.h"

namespace omma {
namespace {

double value(const std::string& text, double x = 0.0) {
  const std::vector<std::string> variables = {"x"};
  return Expression("test", text, variables)(std::span(&x, 1));
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
  EXPECT_EQ(value("1+2*3"), 7.0);
  EXPECT_EQ(value("(1+2)*3"), 9.0);
  EXPECT_EQ(value("10-4-3"), 3.0);
  EXPECT_EQ(value("16/4/2"), 2.0);
  EXPECT_EQ(value("2^3^2"), 512.0);
  EXPECT_EQ(value("-2^2"), -4.0);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("2*-3"), -6.0);
  EXPECT_EQ(value("--3"), 3.0);
  EXPECT_EQ(value(" 1 < 2 "), 1.0);
  EXPECT_EQ(value("1>=2"), 0.0);
  EXPECT_EQ(value("1+1==2"), 1.0);
  EXPECT_EQ(value("if(x>1, x, -x)", 3.0), 3.0);
  EXPECT_EQ(value("if(x>1, x, -x)", 0.5), -0.5);
  EXPECT_EQ(value("min(3,2)+max(3,2)*pow(2,3)"), 26.0);
  EXPECT_EQ(value("floor(-1.5)+sign(-2)+abs(-4)"), 1.0);
  EXPECT_DOUBLE_EQ(value("atan2(1,-1)"), 0.75 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(value("log(e^2)+exp(0)+sqrt(9)"), 6.0);
  EXPECT_DOUBLE_EQ(value("asin(1)+acos(1)+atan(1)"), 0.75 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(value("sin(x)^2+cos(x)^2+tan(pi/4)", 0.7), 2.0);
  EXPECT_EQ(value("1e3*.5"), 500.0);
}

TEST(Expression, NamesTheColumnAndTheNearestName) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      value(text);
    } catch (const CommandError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message("2*sni(x)").find("column 3"), std::string::npos) << message("2*sni(x)");
  EXPECT_NE(message("2*sni(x)").find("did you mean 'sin'"), std::string::npos);
  EXPECT_NE(message("(1+2").find("')' is missing"), std::string::npos);
  EXPECT_NE(message("atan2(1)").find("atan2 takes 2"), std::string::npos);
  EXPECT_NE(message("sin(1,2)").find("sin takes 1 argument"), std::string::npos);
  EXPECT_NE(message("sin").find("'('"), std::string::npos);
  EXPECT_NE(message("1+").find("ends"), std::string::npos);
  EXPECT_NE(message("1 2").find("column 3"), std::string::npos);
  EXPECT_NE(message("").find("ends"), std::string::npos);
  EXPECT_NE(message("1 $ 2").find("'$'"), std::string::npos);
  EXPECT_NE(message(std::string(5000, '(')).find("nested"), std::string::npos);
  EXPECT_NE(message(std::string(5000, '-') + "1").find("accepted"), std::string::npos);
  EXPECT_NE(message(std::string(20000, '1')).find("characters"), std::string::npos);
  std::string tower = "2";
  for (int i = 0; i < 500; ++i) tower += "^2";
  EXPECT_NE(message(tower).find("nested"), std::string::npos);
}

// The deepest formula accepted that needs the most stack: three pending operands at each level.
TEST(Expression, HasRoomForTheDeepestFormulaItAccepts) {
  std::string text = "1";
  double expected = 1.0;
  int levels = 0;
  while (true) {
    const std::string deeper = "max(0,max(0,0<1+1*2^(" + text + ")))";
    try {
      value(deeper);
    } catch (const CommandError&) {
      break;
    }
    text = deeper;
    expected = 1.0;
    ++levels;
  }
  EXPECT_GT(levels, 5);
  EXPECT_EQ(value(text), expected);
}

TEST(RisingFunction, FindsWhereItTurnsAndTheWayBack) {
  const RisingFunction sine([](double x) { return std::sin(x); }, 0.0, 3.0);
  EXPECT_NEAR(sine.end(), 0.5 * std::numbers::pi, 1e-7);
  for (double y = 0.0; y < 0.999; y += 0.0173) EXPECT_NEAR(sine.inverse(y).value(), std::asin(y), 1e-12);
  EXPECT_FALSE(sine.inverse(1.1));
  EXPECT_FALSE(sine.inverse(-0.1));
  EXPECT_FALSE(sine(2.0));

  const RisingFunction tangent([](double x) { return std::tan(x); }, 0.0, std::numbers::pi);
  EXPECT_NEAR(tangent.end(), 0.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(tangent.inverse(1e4).value(), std::atan(1e4), 1e-12);

  const RisingFunction root([](double x) { return 1.0 - std::sqrt(1.0 - x); }, 0.0, 2.0);  // undefined beyond 1
  EXPECT_NEAR(root.end(), 1.0, 1e-9);

  const RisingFunction jump([](double x) { return x < 0.5 ? x : x + 1.0; }, 0.0, 1.0);
  EXPECT_FALSE(jump.inverse(1.0));
  EXPECT_NEAR(jump.inverse(1.75).value(), 0.75, 1e-12);
  EXPECT_EQ(RisingFunction([](double) { return 1.0; }, 0.0, 1.0).end(), 0.0);
}

TEST_F(Deformation, RadialFormulaeEqualTheirLenses) {
  const auto camera = [](const std::string& text) { return make_camera(text, size); };
  expect_equal(camera("expression:r=theta,fov_deg=180"), camera("equidistant:fov_deg=180"));
  expect_equal(camera("expression:r=theta/(pi/2)"), camera("equidistant:fov_deg=180"), 2e-7, 8);
  expect_equal(camera("expression:r=theta,fov_deg=300,fit=full"), camera("equidistant:fov_deg=300,fit=full"));
  expect_equal(camera("expression:r=2*sin(theta/2),fov_deg=200"), camera("equisolid:fov_deg=200"));
  expect_equal(camera("expression:r=2*tan(theta/2),fov_deg=120,fit=width"),
               camera("stereographic:fov_deg=120,fit=width"));
  expect_equal(camera("expression:theta=2*atan(r/2),fov_deg=120,fit=width"),
               camera("stereographic:fov_deg=120,fit=width"));
  expect_equal(camera("expression:r=tan(theta),fov_deg=90,fit=width"), camera("perspective:fov_deg=90,fit=width"));
  expect_equal(camera("expression:theta=atan(r),f=70,cx=60,cy=50"), camera("perspective:f=70,cx=60,cy=50"));
  expect_equal(camera("expression:r=sin(theta),fov_deg=180"), camera("orthographic_fisheye:fov_deg=180"), 1e-6, 0);
  expect_equal(make_camera("expression:r=theta,f=100,cx=70,width=320,height=240", size),
               make_camera("equidistant:f=100,cx=70,width=320,height=240", size));
}

TEST_F(Deformation, FormulaeOfTheImageEqualTheirLenses) {
  const ImageSize wide{200, 100};
  const auto camera = [&](const std::string& text) { return make_camera(text, wide); };
  expect_equal(camera("expression:longitude=u*pi,latitude=v*pi/2"), camera("equirectangular"), 4e-7);
  expect_equal(camera("expression:longitude=u*pi/2,latitude=v*pi/3"),
               camera("equirectangular:longitude_min_deg=-90,longitude_max_deg=90,latitude_min_deg=-60,"
                      "latitude_max_deg=60"),
               4e-7);
  expect_equal(camera("expression:x=u,y=v/aspect,z=-1"), camera("perspective:fov_deg=90,fit=width"));
  // A hole where the formula is not defined.
  const Camera disc = camera("expression:x=u,y=v,z=-sqrt(0.25-u^2-v^2)");
  EXPECT_FALSE(disc.unproject({0.5, 0.5}));
  EXPECT_TRUE(disc.unproject({100.5, 50.5}));
  // Up is up.
  EXPECT_GT(camera("expression:x=u,y=v,z=-1").unproject({100, 10})->direction.y, 0.1);
}

TEST_F(Deformation, FormulaeComeFromFilesAndGoBackToText) {
  const std::string lens = file("lens.txt", "# a lens\n\nr = 2*sin(theta/2)  # equisolid\r\nfov_deg = 90\n");
  expect_equal(make_camera("expression:file=" + lens + ",fov_deg=200", size),
               make_camera("equisolid:fov_deg=200", size));
  for (const std::string& text :
       {"expression:file=" + lens, std::string("expression:r=if(theta<0.5,theta,max(theta,0.2)),f=20,cx=30"),
        std::string("expression:longitude=atan2(u,1),latitude=v,width=80,height=60")}) {
    const Camera camera = make_camera(text, size);
    expect_equal(make_camera(to_text(camera)), camera);
  }
  expect_refused("expression:file=" + file("a.txt", "fov_deg=90\nr = sn(theta)\n"), ErrorKind::input,
                 {"a.txt:2", "sin"});
  expect_refused("expression:file=" + file("b.txt", "r theta\n"), ErrorKind::input, {"b.txt:1", "key = value"});
  expect_refused("expression:file=" + file("c.txt", "r=theta\nr=theta\n"), ErrorKind::input, {"c.txt:2", "twice"});
  expect_refused("expression:file=" + path("none.txt"), ErrorKind::input, {"none.txt"});
}

TEST_F(Deformation, FormulaeThatAreNoCameraAreRefused) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_refused(text, ErrorKind::command, parts);
  };
  refused("expression", {"no formula", "for example"});
  refused("expression:r=theta,fov_dge=3", {"fov_dge", "did you mean 'fov_deg'"});
  refused("expression:r=theta,theta=r", {"theta"});
  refused("expression:x=u,y=v", {"z is missing"});
  refused("expression:longitude=u,latitude=v,fov_deg=90", {"fov_deg"});
  refused("expression:r=-theta", {"does not rise"});
  refused("expression:r=theta-1", {"-1"});
  refused("expression:r=1/theta", {"theta = 0"});
  refused("expression:r=sin(theta),fov_deg=190", {"out of range", "180"});
  refused("expression:r=tan(theta),fov_deg=180.5", {"out of range"});
  refused("expression:r=theta,f=10,fov_deg=90", {"twice"});
  refused("expression:r=theta,fx=10", {"fy"});
  refused("expression:r=theta,f=0", {"out of range"});
  refused("expression:r=theta,cx=1e8", {"sees nothing"});
  refused("expression:x=log(-1),y=0,z=0", {"sees nothing"});
  refused("expression:r=theta,width=100,height=100,f=30", {"shape"});
  refused("expresion:r=theta", {"expression"});
}

TEST_F(Deformation, TablesEqualTheLensTheyWereTakenFrom) {
  std::string rows, swapped;
  for (int deg = 0; deg <= 100; deg += 2) {
    const double radius = 2.0 * 60.0 * std::sin(0.5 * deg * std::numbers::pi / 180.0);
    rows += fmt::format("{}, {}\n", deg, radius);
    swapped += fmt::format("{}\t{}\r\n", radius, deg);
  }
  const Camera expected = make_camera("equisolid:f=60,max_angle_deg=100", size);
  expect_equal(make_camera("table:f=1,file=" + file("t.csv", "# angle, radius\n" + rows), size), expected, 1e-5);
  expect_equal(make_camera("table:f=1,columns=r_theta,file=" + file("s.txt", swapped), size), expected, 1e-5);
  // Without a focal length r = 1 is at the edge of the circle.
  expect_equal(make_camera("table:file=" + file("l.txt", "0 0\n90 1\n"), size), make_camera("equidistant", size), 2e-7,
               8);
}

TEST_F(Deformation, TablesThatAreNoneAreRefused) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    expect_refused("table:file=" + file("t.txt", text), ErrorKind::input, parts);
  };
  refused("", {"0 rows"});
  refused("0 0\n", {"1 rows"});
  refused("0 0\n1 2 3\n", {"t.txt:2", "3 values"});
  refused("0 0\n1 x\n", {"t.txt:2", "'x'"});
  refused("0 0\n1 nan\n", {"t.txt:2"});
  refused("0 0\n1 1\n2 1\n", {"t.txt:3", "larger"});
  refused("0 0\n200 1\n", {"t.txt:2", "180"});
  refused(std::string("\0\xff\0", 3), {"t.txt:1"});
  expect_refused("table", ErrorKind::command, {"file is missing"});
  expect_refused("table:file=x,columns=a", ErrorKind::command, {"theta_r"});
}

}  // namespace
}  // namespace omma
