// Pictures against references that a person has looked at: each line of cases.txt is a command anybody could type.
#include <fmt/format.h>

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
  std::string name, max, mean;
  std::vector<std::string> words;
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
    const auto word = [&](size_t i) { return i < fields.size() ? words_of(fields[i]) : std::vector<std::string>{}; };
    if (word(0).size() == 1) image.name = word(0)[0];
    image.words = word(1);
    if (word(2).size() == 1) image.max = word(2)[0];
    if (word(3).size() == 1) image.mean = word(3)[0];
    cases.push_back(image);
  }
  return cases;
}

class ImageTest : public ToolTest, public testing::WithParamInterface<Case> {};

TEST_P(ImageTest, LooksAsItShould) {
  const Case& image = GetParam();
  ASSERT_FALSE(image.max.empty() || image.mean.empty()) << "cases.txt: four fields are expected";
  fs::create_directories(places::image_output);
  const fs::path reference = folder / "reference" / (image.name + ".png");
  const fs::path picture = fs::path(places::image_output) / (image.name + ".png");
  const fs::path difference = fs::path(places::image_output) / (image.name + ".difference.png");
  fs::remove(difference);

  std::vector<std::string> words{"render"};
  words.insert(words.end(), image.words.begin(), image.words.end());
  words.insert(words.end(), {"-o", picture.string()});
  const ToolResult rendered = run(words);
  ASSERT_EQ(rendered.exit_code, 0) << fmt::format("omma {}\n{}", fmt::join(words, " "), rendered.err);
  ASSERT_TRUE(fs::exists(reference)) << "there is no reference " << reference << "\nthe new picture is " << picture
                                     << "\nlook at it, and copy it there if it is right";

  const ToolResult compared = run({"compare", reference.string(), picture.string(), "--max-max", image.max,
                                   "--max-mean", image.mean, "--diff", difference.string()});
  EXPECT_EQ(compared.exit_code, 0) << compared.out << compared.err << "reference  " << reference << "\npicture    "
                                   << picture << "\ndifference " << difference;
  if (compared.exit_code == 0) fs::remove(difference);
}

std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Cases, ImageTest, testing::ValuesIn(read_cases()), case_name);

}  // namespace
}  // namespace omma
