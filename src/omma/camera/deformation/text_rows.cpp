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

std::vector<TextRow> read_rows(const std::filesystem::path& path) {
  std::vector<TextRow> rows;
  const std::string text = read_file(path);
  size_t line_number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    line = line.substr(0, line.find('#'));
    TextRow row;
    constexpr std::string_view separators = " \t,;\r";
    for (size_t at = line.find_first_not_of(separators); at != std::string_view::npos;) {
      const size_t stop = std::min(line.find_first_of(separators, at), line.size());
      row.words.emplace_back(line.substr(at, stop - at));
      at = line.find_first_not_of(separators, stop);
    }
    if (row.words.empty()) continue;
    row.place = fmt::format("{}:{}", path.string(), line_number);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace omma
