// Pictures against references that a person has looked at: each line of cases.txt is a command anybody could type.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "omma/base/names.h"
#include "tests/cli/tool.h"
#include "tests/places.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(places::source) / "tests/image";

struct Case {
  std::string name, channel;
  std::vector<std::string> words, limits;
};

void PrintTo(const Case& image, std::ostream* stream) { *stream << image.name; }

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<Case> read_cases() {
  std::ifstream stream(folder / "cases.txt");
  std::vector<Case> cases;
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> fields = split(line.substr(0, line.find('#')), '|');
    if (fields.size() <= 1) continue;
    Case image;
    const std::vector<std::string> name = words_of(fields[0]);
    if (name.size() == 1) {
      const std::vector<std::string> parts = split(name[0], ':');
      image.name = parts[0];
      image.channel = parts.size() > 1 ? parts[1] : "color";
    }
    image.words = words_of(fields[1]);
    for (size_t i = 2; i < fields.size(); ++i) {
      for (const std::string& limit : words_of(fields[i])) image.limits.push_back(limit);
    }
    cases.push_back(image);
  }
  return cases;
}

class ImageTest : public ToolTest, public testing::WithParamInterface<Case> {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    fs::create_directory_symlink(folder / "scenes", file("scenes"));
  }
};

TEST_P(ImageTest, LooksAsItShould) {
  const Case& image = GetParam();
  ASSERT_TRUE(image.limits.size() == 1 || image.limits.size() == 2) << "cases.txt: three or four fields are expected";
  fs::create_directories(places::image_output);
  const fs::path reference = folder / "reference" / (image.name + ".png");
  const fs::path picture = fs::path(places::image_output) / (image.name + ".png");
  const fs::path difference = fs::path(places::image_output) / (image.name + ".difference.png");
  fs::remove(difference);

  std::vector<std::string> words{"render"};
  words.insert(words.end(), image.words.begin(), image.words.end());
  words.insert(words.end(), {"-o", fmt::format("{}:{}", picture.string(), image.channel)});
  const ToolResult rendered = run(words);
  ASSERT_EQ(rendered.exit_code, 0) << fmt::format("omma {}\n{}", fmt::join(words, " "), rendered.err);
  if (!fs::exists(reference) && std::getenv("OMMA_WRITE_REFERENCES") != nullptr) {
    fs::copy_file(picture, reference);
    GTEST_SKIP() << "look at it before it is committed: " << reference.string();
  }
  ASSERT_TRUE(fs::exists(reference)) << "there is no reference " << reference << "\nthe new picture is " << picture
                                     << "\nlook at it; if it is right, ./dev references takes it for one";

  std::vector<std::string> comparison{"compare", reference.string(), picture.string()};
  comparison.insert(comparison.end(), {"--diff", difference.string()});
  if (image.limits.size() == 2) {
    comparison.insert(comparison.end(), {"--max-max", image.limits[0], "--max-mean", image.limits[1]});
  } else {
    comparison.insert(comparison.end(), {"--max-id-share", image.limits[0]});
  }
  const ToolResult compared = run(comparison);
  EXPECT_EQ(compared.exit_code, 0) << compared.out << compared.err << "reference  " << reference << "\npicture    "
                                   << picture << "\ndifference " << difference;
  if (compared.exit_code == 0) fs::remove(difference);
}

std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Cases, ImageTest, testing::ValuesIn(read_cases()), case_name);

}  // namespace
}  // namespace omma
