#include <gtest/gtest.h>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {
namespace {

const std::vector<std::string> lenses{"perspective", "equidistant", "equisolid"};

TEST(Names, NearestIsFoundAndFarIsNot) {
  EXPECT_EQ(nearest_name("equidistnat", lenses), "equidistant");
  EXPECT_EQ(nearest_name("equisold", lenses), "equisolid");
  EXPECT_EQ(nearest_name("psrn", std::vector<std::string>{"ssim", "psnr"}), "psnr");
  EXPECT_EQ(nearest_name("cube", lenses), std::nullopt);
  EXPECT_EQ(nearest_name("", lenses), std::nullopt);
  EXPECT_EQ(nearest_name("x", {}), std::nullopt);
}

TEST(Names, UnknownNameSaysWhatThereIs) {
  EXPECT_EQ(unknown_name("camera", "equisold", lenses),
            "unknown camera 'equisold'; did you mean 'equisolid'? (one of: perspective, equidistant, equisolid)");
  EXPECT_EQ(unknown_name("camera", "zzz", {}), "unknown camera 'zzz'");
}

TEST(Names, SpecIsANameWithValues) {
  const Spec spec = parse_spec("city:blocks=54,seed=");
  EXPECT_EQ(spec.name, "city");
  EXPECT_EQ(spec.values, (std::map<std::string, std::string>{{"blocks", "54"}, {"seed", ""}}));
  EXPECT_TRUE(parse_spec("city").values.empty());
  EXPECT_EQ(parse_spec("a:b=c=d").values.at("b"), "c=d");
}

TEST(Names, BrokenSpecsAreRefused) {
  for (const char* text : {"", ":a=1", "city:blocks", "city:=1", "city:a=1,a=2", "city:a=1,"}) {
    EXPECT_THROW(parse_spec(text), CommandError) << text;
  }
}

TEST(Names, NumbersAreWholeTexts) {
  EXPECT_EQ(parse_number("x", "-1.5e2"), -150.0);
  EXPECT_EQ(parse_number("x", "+3"), 3.0);
  EXPECT_EQ(parse_integer("x", "-7"), -7);
  for (const char* text : {"", " 1", "1 ", "1x", "nan", "inf", "1e999", "--1", "+-1", "1,5"}) {
    EXPECT_THROW(parse_number("x", text), CommandError) << text;
  }
  for (const char* text : {"", "1.0", "99999999999999999999", "0x10", "1e3"}) {
    EXPECT_THROW(parse_integer("x", text), CommandError) << text;
  }
}

TEST(Names, SplitKeepsEmptyParts) {
  EXPECT_EQ(split("a,,b,", ','), (std::vector<std::string>{"a", "", "b", ""}));
  EXPECT_EQ(split("", ','), std::vector<std::string>{});
  EXPECT_EQ(split("a", ','), std::vector<std::string>{"a"});
}

}  // namespace
}  // namespace omma
