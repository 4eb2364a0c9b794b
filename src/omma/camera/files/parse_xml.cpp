#include <algorithm>
#include <pugixml.hpp>

#include "omma/camera/files/parse.h"

namespace omma {
namespace {

class Lines {
 public:
  explicit Lines(std::string_view text) {
    for (size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(i));
    }
  }
  int of(std::ptrdiff_t offset) const {
    return static_cast<int>(std::ranges::lower_bound(ends_, offset) - ends_.begin()) + 1;
  }

 private:
  std::vector<std::ptrdiff_t> ends_;
};

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// An element is a map when it has attributes or other elements within it, else its text. OpenCV writes the items of a
// list as elements named _.
void add_element(TreeBuilder& tree, const Lines& lines, const pugi::xml_node& element) {
  const int line = lines.of(element.offset_debug());
  const pugi::xml_attribute type = element.attribute("type_id");
  const bool has_attributes = element.first_attribute() && !(type && !type.next_attribute());
  const bool has_elements = std::any_of(element.begin(), element.end(),
                                        [](const pugi::xml_node& child) { return child.type() == pugi::node_element; });
  if (!has_attributes && !has_elements) {
    tree.scalar(trimmed(element.text().get()), false, line);
    return;
  }
  tree.begin_map(line, type.value());
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    tree.scalar(std::string("@") + attribute.name(), true, line);
    tree.scalar(attribute.value(), false, line);
  }
  for (const pugi::xml_node& child : element.children()) {
    if (child.type() != pugi::node_element) continue;
    tree.scalar(child.name(), true, lines.of(child.offset_debug()));
    add_element(tree, lines, child);
  }
  tree.end();
}

}  // namespace

Value parse_xml(const Place& file, std::string_view text, const Limits& limits) {
  // pugixml makes its own tree first, of no more than a node for each of these.
  ValueCounter values(file, limits);
  int line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (c == '<' || c == '=') values.add(line);
  }
  const Lines lines(text);
  TreeBuilder tree(file, limits, true);
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) tree.fail(lines.of(result.offset), fmt::format("is no XML: {}", result.description()));
  tree.begin_map(1);
  for (const pugi::xml_node& child : document.children()) {
    if (child.type() != pugi::node_element) continue;
    tree.scalar(child.name(), true, lines.of(child.offset_debug()));
    add_element(tree, lines, child);
  }
  tree.end();
  return tree.take();
}

}  // namespace omma
