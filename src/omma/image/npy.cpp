#include "omma/image/npy.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

#include "omma/base/error.h"
#include "omma/base/file.h"

namespace omma {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

constexpr std::string_view magic{"\x93NUMPY", 6};

struct Header {
  char kind = 0;  ///< 'b', 'i', 'u' or 'f'
  size_t item_size = 0;
  bool big_endian = false;
  bool fortran_order = false;
  std::vector<size_t> shape;
  size_t count = 0;
  size_t data_offset = 0;
};

/// Reads the Python dictionary of the header: strings, booleans and tuples of whole numbers.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  Header parse() {
    bool has_descr = false, has_order = false, has_shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string_view key = string();
      expect(':');
      if (key == "descr") {
        parse_dtype(string());
        has_descr = true;
      } else if (key == "fortran_order") {
        header_.fortran_order = boolean();
        has_order = true;
      } else if (key == "shape") {
        parse_shape();
        has_shape = true;
      } else {
        fail(fmt::format("unknown key '{}'", key));
      }
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    if (!has_descr || !has_order || !has_shape) {
      fail("'descr', 'fortran_order' and 'shape' are expected");
    }
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError("{}: broken .npy header at character {}: {}", path_, position_, why);
  }

  char peek() {
    while (position_ < text_.size() && std::strchr(" \t\r\n", text_[position_])) ++position_;
    return position_ < text_.size() ? text_[position_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++position_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(fmt::format("'{}' is expected", c));
  }

  std::string_view string() {
    const char quote = peek();
    if (quote == '[') fail("arrays of records are not supported, a plain number type is expected");
    if (quote != '\'' && quote != '"') fail("a quoted string is expected");
    const size_t begin = ++position_;
    const size_t end = text_.find(quote, begin);
    if (end == std::string_view::npos) fail("a string does not end");
    position_ = end + 1;
    return text_.substr(begin, end - begin);
  }

  bool boolean() {
    peek();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(position_).starts_with(word)) {
        position_ += word.size();
        return value;
      }
    }
    fail("True or False is expected");
  }

  size_t number() {
    if (peek() < '0' || peek() > '9') fail("a whole number is expected");
    size_t value = 0;
    while (position_ < text_.size() && text_[position_] >= '0' && text_[position_] <= '9') {
      if (value > std::numeric_limits<size_t>::max() / 10 - 1) fail("a dimension is too large");
      value = 10 * value + size_t(text_[position_++] - '0');
    }
    return value;
  }

  void parse_shape() {
    constexpr size_t max_dimensions = 32;  // NumPy's own limit
    expect('(');
    while (!accept(')')) {
      header_.shape.push_back(number());
      if (header_.shape.size() > max_dimensions) fail("more than 32 dimensions");
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
  }

  void parse_dtype(std::string_view dtype) {
    const std::string accepted = "b1, i1, i2, i4, i8, u1, u2, u4, u8, f2, f4 or f8 is expected";
    if (dtype.size() != 3 || !std::strchr("<>|=", dtype[0])) {
      fail(fmt::format("dtype '{}' is not supported; {}", dtype, accepted));
    }
    header_.big_endian = dtype[0] == '>';
    header_.kind = dtype[1];
    header_.item_size = size_t(dtype[2] - '0');
    const std::string_view sizes = header_.kind == 'b'                          ? "1"
                                   : header_.kind == 'f'                        ? "248"
                                   : header_.kind == 'i' || header_.kind == 'u' ? "1248"
                                                                                : "";
    if (sizes.find(dtype[2]) == std::string_view::npos) {
      fail(fmt::format("dtype '{}' is not supported; {}", dtype, accepted));
    }
  }

  std::string_view text_;
  const std::string& path_;
  size_t position_ = 0;
  Header header_;
};

/// The number of elements, or nothing when their bytes would not fit in memory's addresses.
std::optional<size_t> element_count(const Header& header) {
  size_t count = 1;
  for (const size_t extent : header.shape) {
    if (extent != 0 && count > std::numeric_limits<size_t>::max() / 16 / extent) return std::nullopt;
    count *= extent;
  }
  return count;
}

Header read_header(const std::string& bytes, const std::string& path, const Limits& limits) {
  if (bytes.empty()) throw InputError("{}: the file is empty, a .npy file is expected", path);
  if (!bytes.starts_with(magic) || bytes.size() < 10) {
    throw InputError("{}: is not a .npy file (it does not begin with \\x93NUMPY)", path);
  }
  const int version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3) {
    throw InputError("{}: .npy version {} is not known, 1 to 3 are", path, version);
  }
  const size_t length_bytes = version == 1 ? 2 : 4;
  size_t length = 0;
  for (size_t i = 0; i < length_bytes && 8 + i < bytes.size(); ++i) {
    length |= size_t(static_cast<unsigned char>(bytes[8 + i])) << (8 * i);
  }
  const size_t begin = 8 + length_bytes;
  if (bytes.size() < begin || bytes.size() - begin < length) {
    throw InputError("{}: truncated: the header should be {} bytes long, the whole file is {}", path, length,
                     bytes.size());
  }
  Header header = HeaderParser(std::string_view(bytes).substr(begin, length), path).parse();
  header.data_offset = begin + length;
  const std::optional<size_t> count = element_count(header);
  const size_t available = bytes.size() - header.data_offset;
  if (!count || *count * header.item_size > available) {
    throw InputError("{}: truncated: shape ({}) of {}-byte numbers needs more than the {} bytes of data", path,
                     fmt::join(header.shape, ", "), header.item_size, available);
  }
  if (*count * header.item_size < available) {
    throw InputError("{}: {} bytes follow after the data that the header announces", path,
                     available - *count * header.item_size);
  }
  if (*count / 4 > limits.picture_pixels) {
    throw InputError("{}: shape ({}): {} numbers, four a pixel are read: {}", path, fmt::join(header.shape, ", "),
                     *count, limit_text(limits, &Limits::picture_pixels));
  }
  header.count = *count;
  return header;
}

template <typename Stored>
Stored load(const char* bytes, bool big_endian) {
  char ordered[sizeof(Stored)];
  for (size_t i = 0; i < sizeof(Stored); ++i) {
    ordered[i] = bytes[big_endian ? sizeof(Stored) - 1 - i : i];
  }
  return std::bit_cast<Stored>(ordered);
}

/// IEEE half precision, which C++20 has no type for.
struct Half {
  uint16_t bits;
  operator float() const { return glm::unpackHalf1x16(bits); }
};

template <typename T, typename Stored>
T convert(Stored stored, const std::string& path, size_t index) {
  if constexpr (std::is_integral_v<T>) {
    const auto value = static_cast<double>(stored);
    if (!(value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max()) ||
        value != std::floor(value)) {
      throw InputError("{}: element {} is {}, a whole number of 32 bits is expected", path, index, value);
    }
  }
  return static_cast<T>(stored);
}

/// Calls `visit(c_index, stored_index)` for every element, in C order.
template <typename Visit>
void for_each_element(const Header& header, const Visit& visit) {
  if (!header.fortran_order) {
    for (size_t i = 0; i < header.count; ++i) visit(i, i);
    return;
  }
  const size_t dimensions = header.shape.size();
  std::vector<size_t> index(dimensions, 0), stride(dimensions, 1);
  for (size_t d = 1; d < dimensions; ++d) stride[d] = stride[d - 1] * header.shape[d - 1];
  size_t stored = 0;
  for (size_t i = 0; i < header.count; ++i) {
    visit(i, stored);
    for (size_t d = dimensions; d-- > 0;) {
      stored += stride[d];
      if (++index[d] < header.shape[d]) break;
      stored -= stride[d] * header.shape[d];
      index[d] = 0;
    }
  }
}

template <typename Stored, typename T>
void read_values(const std::string& bytes, const Header& header, const std::string& path, std::vector<T>& values) {
  const char* data = bytes.data() + header.data_offset;
  for_each_element(header, [&](size_t i, size_t stored) {
    values[i] = convert<T>(load<Stored>(data + stored * sizeof(Stored), header.big_endian), path, i);
  });
}

template <typename T>
constexpr const char* dtype_name() {
  return std::is_same_v<T, float> ? "<f4" : std::is_same_v<T, double> ? "<f8" : "<i4";
}

}  // namespace

template <typename T>
NpyArray<T> read_npy(const std::filesystem::path& path, const Limits& limits) {
  const std::string name = path.string();
  const std::string bytes = read_file(path, limits);
  const Header header = read_header(bytes, name, limits);
  NpyArray<T> array;
  array.shape = header.shape;
  array.integer = header.kind != 'f';
  array.values.resize(header.count);
  const auto read = [&]<typename Stored>(Stored) { read_values<Stored>(bytes, header, name, array.values); };
  switch (header.kind * 10 + int(header.item_size)) {
    case 'b' * 10 + 1:
    case 'u' * 10 + 1:
      read(uint8_t{});
      break;
    case 'u' * 10 + 2:
      read(uint16_t{});
      break;
    case 'u' * 10 + 4:
      read(uint32_t{});
      break;
    case 'u' * 10 + 8:
      read(uint64_t{});
      break;
    case 'i' * 10 + 1:
      read(int8_t{});
      break;
    case 'i' * 10 + 2:
      read(int16_t{});
      break;
    case 'i' * 10 + 4:
      read(int32_t{});
      break;
    case 'i' * 10 + 8:
      read(int64_t{});
      break;
    case 'f' * 10 + 2:
      read(Half{});
      break;
    case 'f' * 10 + 4:
      read(float{});
      break;
    default:
      read(double{});
      break;
  }
  return array;
}

template <typename T>
void write_npy(const std::filesystem::path& path, std::span<const size_t> shape, std::span<const T> values) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", dtype_name<T>(),
                                   fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  constexpr size_t preamble = 10, alignment = 64;
  header.append((alignment - (preamble + header.size() + 1) % alignment) % alignment, ' ');
  header += '\n';
  write_stream(path, [&](std::ostream& stream) {
    stream << magic << '\x01' << '\0' << char(header.size() & 0xff) << char(header.size() >> 8) << header;
    stream.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
  });
}

template NpyArray<float> read_npy(const std::filesystem::path&, const Limits&);
template NpyArray<double> read_npy(const std::filesystem::path&, const Limits&);
template NpyArray<int32_t> read_npy(const std::filesystem::path&, const Limits&);
template void write_npy(const std::filesystem::path&, std::span<const size_t>, std::span<const float>);
template void write_npy(const std::filesystem::path&, std::span<const size_t>, std::span<const double>);
template void write_npy(const std::filesystem::path&, std::span<const size_t>, std::span<const int32_t>);

}  // namespace omma
