#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <sstream>

#include "omma/camera/files/parse.h"

namespace omma {
namespace {

// Blanks the words of a directive that only OpenCV knows, and keeps its line.
std::string without_opencv_header(std::string_view text) {
  std::string yaml(text);
  const size_t at = yaml.find("%YAML:");
  if (at == std::string::npos || (at > 0 && yaml[at - 1] != '\n')) return yaml;
  for (size_t i = at; i < yaml.size() && yaml[i] != '\n'; ++i) yaml[i] = ' ';
  return yaml;
}

// "tag:yaml.org,2002:opencv-matrix" and "!opencv-matrix" are "opencv-matrix"; "?" and "!" say plain and quoted.
std::string tag_name(const std::string& tag) {
  const size_t colon = tag.find_last_of(":!?");
  return colon == std::string::npos ? tag : tag.substr(colon + 1);
}

class Handler : public YAML::EventHandler {
 public:
  explicit Handler(TreeBuilder& tree) : tree_(tree) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (!tree_.empty()) tree_.fail(line(mark), "a second document begins here; one is accepted");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { tree_.null(line(mark)); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    tree_.fail(line(mark), "a reference to an anchor (*) is not accepted; write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& text) override {
    tree_.scalar(text, tag == "!", line(mark));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    tree_.begin_list(line(mark), tag_name(tag));
  }
  void OnSequenceEnd() override { tree_.end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, YAML::EmitterStyle::value) override {
    tree_.begin_map(line(mark), tag_name(tag));
  }
  void OnMapEnd() override { tree_.end(); }

 private:
  static int line(const YAML::Mark& mark) { return mark.line + 1; }
  TreeBuilder& tree_;
};

}  // namespace

Value parse_yaml(const Place& file, std::string_view text, const Limits& limits) {
  // yaml-cpp's scanner needs time that grows with the square of some malformed texts.
  constexpr size_t max_yaml_bytes = size_t{1} << 20;
  if (text.size() > max_yaml_bytes) {
    file.fail("has {} bytes; YAML of up to {} is accepted", text.size(), max_yaml_bytes);
  }
  TreeBuilder tree(file, limits);
  Handler handler(tree);
  std::istringstream stream(without_opencv_header(text));
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(handler)) {
    }
  } catch (const YAML::Exception& error) {
    tree.fail(error.mark.line + 1, fmt::format("is no YAML: {}", error.msg));
  }
  return tree.take();
}

}  // namespace omma
