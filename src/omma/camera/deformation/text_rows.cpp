#include "omma/camera/deformation/text_rows.h"

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"

namespace omma {
namespace {

// Reads one word of a row; what is wrong with it is wrong with the file.
template <typename Parse>
auto parsed(const TextRow& row, size_t word, Parse parse) {
  if (word >= row.words.size()) {
    throw InputError("{}: {} value{}, more are expected", row.place, row.words.size(),
                     row.words.size() == 1 ? "" : "s");
  }
  try {
    return parse(row.place, row.words[word].substr(0, 100));
  } catch (const CommandError& error) {
    throw InputError("{}", error.what());
  }
}

}  // namespace

double TextRow::number(size_t word) const { return parsed(*this, word, parse_number); }

long TextRow::integer(size_t word) const { return parsed(*this, word, parse_integer); }

void for_each_line(const std::filesystem::path& path, const Limits& limits,
                   const std::function<void(std::string_view, size_t)>& visit) {
  const std::string text = read_file(path, limits);
  size_t number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    visit(line.substr(0, line.find('#')), ++number);
  }
}

void for_each_row(const std::filesystem::path& path, const Limits& limits,
                  const std::function<void(const TextRow&)>& visit) {
  constexpr size_t most_words = 4096;  // a face of an OBJ has as many as corners
  const std::string name = path.string();
  TextRow row;
  for_each_line(path, limits, [&](std::string_view line, size_t number) {
    constexpr std::string_view separators = " \t,;\r";
    row.words.clear();
    for (size_t at = line.find_first_not_of(separators); at != std::string_view::npos;) {
      const size_t stop = std::min(line.find_first_of(separators, at), line.size());
      if (row.words.size() == most_words) throw InputError("{}:{}: more than {} words", name, number, most_words);
      row.words.emplace_back(line.substr(at, stop - at));
      at = line.find_first_not_of(separators, stop);
    }
    if (row.words.empty()) return;
    row.place = fmt::format("{}:{}", name, number);
    visit(row);
  });
}

}  // namespace omma
