// Effects as texts: what is understood, what is refused and how.
#include "omma/shading/effects.h"

#include <gtest/gtest.h>

#include <set>

#include "omma/base/error.h"

namespace omma {
namespace {

void expect_refusal(const std::string& text, const std::vector<std::string>& fragments) {
  try {
    make_effect(text);
    ADD_FAILURE() << text << " is accepted";
  } catch (const CommandError& error) {
    for (const std::string& fragment : fragments) {
      EXPECT_NE(std::string(error.what()).find(fragment), std::string::npos) << error.what();
    }
  }
}

TEST(EffectsTest, EveryEffectHasDefaultsThatItAcceptsAndAnExample) {
  EXPECT_GE(effects().size(), 5u);
  std::set<std::string> names;
  for (const EffectInfo& info : effects()) {
    SCOPED_TRACE(info.name);
    EXPECT_TRUE(names.insert(info.name).second);
    EXPECT_EQ(make_effect(info.name).values.size(), info.parameters.size());
    EXPECT_EQ(make_effect(info.example).info, &info);
    for (const EffectParameter& parameter : info.parameters) {
      EXPECT_NO_THROW(make_effect(fmt::format("{}:{}={}", info.name, parameter.name, parameter.default_text)));
      expect_refusal(fmt::format("{}:{}=", info.name, parameter.name), {parameter.name});
      if (!parameter.is_number()) continue;
      for (const double value : {parameter.min - 1.0, parameter.max + 1.0}) {
        expect_refusal(fmt::format("{}:{}={}", info.name, parameter.name, value), {parameter.name, "between"});
      }
      expect_refusal(fmt::format("{}:{}=nan", info.name, parameter.name), {parameter.name});
    }
  }
}

TEST(EffectsTest, ValuesComeInTheirUnits) {
  const Effect wires = make_effect("wireframe:color=#ff8000,width_px=3");
  EXPECT_EQ(std::get<float>(wires.values[0]), 3.0f);
  const auto color = std::get<glm::vec3>(wires.values[1]);
  EXPECT_FLOAT_EQ(color.r, 1.0f);
  EXPECT_NEAR(color.g, 0.2158605f, 1e-6);  // IEC 61966-2-1 of 128 / 255
  EXPECT_FLOAT_EQ(color.b, 0.0f);
  EXPECT_EQ(std::get<glm::vec3>(make_effect("wireframe:color=ff8000").values[1]), color);
  EXPECT_EQ(std::get<glm::vec3>(make_effect("wireframe:color=white").values[1]), glm::vec3(1.0f));
  EXPECT_EQ(std::get<int>(make_effect("hatching").values[4]), 0);
  EXPECT_EQ(std::get<int>(make_effect("hatching:map=world").values[4]), 1);
}

TEST(EffectsTest, WrongTextsAreRefusedWithTheNearestName) {
  expect_refusal("wirefrane", {"unknown effect 'wirefrane'", "did you mean 'wireframe'"});
  expect_refusal("wireframe:widht_px=2", {"'widht_px'", "did you mean 'width_px'"});
  expect_refusal("wireframe:width_px=2,width_px=3", {"twice"});
  expect_refusal("wireframe:width_px", {"key=value"});
  expect_refusal("wireframe:color=blakc", {"color", "did you mean 'black'", "hexadecimal"});
  for (const char* color : {"#12345", "#1234567", "12345g", "-12345", "+12345", "0x1234", "1,0,0"}) {
    expect_refusal(fmt::format("wireframe:color={}", color), {color == std::string("1,0,0") ? "key=value" : color});
  }
  expect_refusal("hatching:map=wrld", {"map", "did you mean 'world'"});
  expect_refusal("", {"name"});
}

TEST(EffectsTest, ChainsAreShortAndPaintOnce) {
  const Effect wires = make_effect("wireframe"), brick = make_effect("brick"), checker = make_effect("checker");
  EXPECT_NO_THROW(check_effects(std::vector{brick, wires, wires, wires}));
  EXPECT_THROW(check_effects(std::vector(max_effects + 1, wires)), CommandError);
  EXPECT_THROW(check_effects(std::vector{brick, wires, checker}), CommandError);
}

}  // namespace
}  // namespace omma
