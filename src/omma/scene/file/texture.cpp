// Pictures, embedded in a scene file or beside it, as 8-bit RGBA.
#include <algorithm>
#include <cctype>
#include <optional>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/codec/decode.h"
#include "omma/scene/file/import.h"

namespace omma::file {
namespace {

/// The largest side that current GPUs take, and what four such sides would need in memory is already absurd.
constexpr int max_side = 16384;

void set_placeholder(Texture& texture) {
  constexpr int side = 64, square = 8;
  texture.width = texture.height = side;
  texture.texels.clear();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool lit = (x / square + y / square) % 2 == 0;
      texture.texels.push_back(lit ? glm::u8vec4(255, 0, 255, 255) : glm::u8vec4(0, 0, 0, 255));
    }
  }
}

void require_usable(int64_t width, int64_t height) {
  if (width < 1 || height < 1 || width > max_side || height > max_side) {
    throw InputError("it is {} x {}; at most {} x {} can be used", width, height, max_side, max_side);
  }
}

/// Throws InputError saying why.
void decode(std::string_view bytes, const std::string& extension, Texture& texture) {
  Pixels pixels = decode_picture(bytes, extension,
                                 [](const PictureInfo& info) { require_usable(info.size.width, info.size.height); });
  texture.width = pixels.info.size.width;
  texture.height = pixels.info.size.height;
  const size_t components = size_t(pixels.stored());
  const std::vector<uint8_t> values = to_8_bits(std::move(pixels));
  texture.texels.resize(values.size() / components);
  for (size_t i = 0; i < texture.texels.size(); ++i) {
    const uint8_t* v = &values[i * components];
    texture.texels[i] = components == 1   ? glm::u8vec4(v[0], v[0], v[0], 255)
                        : components == 2 ? glm::u8vec4(v[0], v[0], v[0], v[1])
                        : components == 3 ? glm::u8vec4(v[0], v[1], v[2], 255)
                                          : glm::u8vec4(v[0], v[1], v[2], v[3]);
  }
}

/// assimp gives pictures as a file's bytes (height 0) or as plain BGRA texels.
void decode(const aiTexture& source, Texture& texture) {
  if (source.mHeight == 0) {
    const auto* bytes = reinterpret_cast<const char*>(source.pcData);
    if (!bytes || source.mWidth == 0) throw InputError("it is empty");
    std::string extension = source.achFormatHint[0] ? source.achFormatHint : "";
    if (!extension.empty()) extension = "." + extension;
    decode({bytes, source.mWidth}, extension, texture);
    return;
  }
  require_usable(source.mWidth, source.mHeight);
  texture.width = static_cast<int>(source.mWidth);
  texture.height = static_cast<int>(source.mHeight);
  for (size_t i = 0; i < size_t{source.mWidth} * source.mHeight; ++i) {
    const aiTexel& texel = source.pcData[i];
    texture.texels.emplace_back(texel.r, texel.g, texel.b, texel.a);
  }
}

std::string percent_decoded(const std::string& text) {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto hex = [&](size_t k) { return k < text.size() && std::isxdigit(static_cast<unsigned char>(text[k])); };
    if (text[i] == '%' && hex(i + 1) && hex(i + 2)) {
      result += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

bool equal_ignoring_case(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Beside the scene: by its path, by its name alone (FBX and MTL keep paths of the author's disk), by a name whose
/// case differs (they come from Windows).
std::optional<std::filesystem::path> find_picture(const std::filesystem::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  std::error_code ignored;
  for (const std::string& spelling : {name, percent_decoded(name)}) {
    const std::filesystem::path path(spelling);
    for (const auto& candidate : {folder / path, folder / path.filename()}) {
      if (std::filesystem::is_regular_file(candidate, ignored)) return candidate;
    }
    for (const auto& parent : {(folder / path).parent_path(), folder}) {
      for (const auto& entry : std::filesystem::directory_iterator(parent, ignored)) {
        if (entry.is_regular_file(ignored) &&
            equal_ignoring_case(entry.path().filename().string(), path.filename().string())) {
          return entry.path();
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace

int import_texture(Import& import, const std::string& name, bool srgb, Texture::Wrap wrap_u, Texture::Wrap wrap_v) {
  const std::string key = fmt::format("{}|{}|{}|{}", name, srgb, static_cast<int>(wrap_u), static_cast<int>(wrap_v));
  const auto [entry, fresh] = import.texture_of_key.try_emplace(key, static_cast<int>(import.scene.textures.size()));
  if (!fresh) return entry->second;
  Texture texture;
  texture.name = name;
  texture.srgb = srgb;
  texture.wrap_u = wrap_u;
  texture.wrap_v = wrap_v;
  try {
    if (const aiTexture* embedded = import.source.GetEmbeddedTexture(name.c_str())) {
      decode(*embedded, texture);
    } else {
      const auto path = find_picture(
          import.path.parent_path().empty() ? std::filesystem::path(".") : import.path.parent_path(), name);
      if (!path) throw InputError("there is no such file");
      decode(read_file(*path), path->extension().string(), texture);
    }
  } catch (const Error& error) {
    warn(fmt::format("{}: texture '{}' cannot be used ({}); a checker of magenta and black stands in",
                     import.path.string(), name, error.what()));
    set_placeholder(texture);
  }
  import.scene.textures.push_back(std::move(texture));
  return entry->second;
}

}  // namespace omma::file
