// Pictures, embedded in a scene file or beside it, as 8-bit RGBA.
#include <algorithm>
#include <cctype>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/codec/decode.h"
#include "omma/image/image.h"
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

/// Counts a texture's texels, or throws InputError saying why there cannot be as many.
void take_texels(Import& import, int64_t width, int64_t height) {
  if (width < 1 || height < 1 || width > max_side || height > max_side) {
    throw InputError("it is {} x {}; at most {} x {} can be used", width, height, max_side, max_side);
  }
  const ImageSize size{static_cast<int>(width), static_cast<int>(height)};
  if (const std::string why = size_refusal(size, import.limits); !why.empty()) throw InputError("it has {}", why);
  const auto count = static_cast<size_t>(width * height);
  if (count > import.limits.scene_texels - std::min(import.texels, import.limits.scene_texels)) {
    throw InputError("it is {} x {}, and textures before it have {} texels: {}", width, height, import.texels,
                     limit_text(import.limits, &Limits::scene_texels));
  }
  import.texels += count;
}

/// Throws InputError saying why.
void decode(Import& import, std::string_view bytes, const std::string& extension, Texture& texture) {
  Pixels pixels = decode_picture(
      bytes, extension, [&](const PictureInfo& info) { take_texels(import, info.size.width, info.size.height); });
  texture.width = pixels.info.size.width;
  texture.height = pixels.info.size.height;
  const size_t components = size_t(pixels.stored());
  const SampleVector<uint8_t> values = to_8_bits(std::move(pixels));
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
void decode(Import& import, const aiTexture& source, Texture& texture) {
  if (source.mHeight == 0) {
    const auto* bytes = reinterpret_cast<const char*>(source.pcData);
    if (!bytes || source.mWidth == 0) throw InputError("it is empty");
    std::string extension = source.achFormatHint[0] ? source.achFormatHint : "";
    if (!extension.empty()) extension = "." + extension;
    decode(import, {bytes, source.mWidth}, extension, texture);
    return;
  }
  take_texels(import, source.mWidth, source.mHeight);
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
/// case differs (they come from Windows). Throws InputError where there is none within reach.
std::filesystem::path find_picture(const Reach& reach, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path& folder = reach.folder();
  std::error_code ignored;
  std::filesystem::path outside;
  for (const std::string& spelling : {name, percent_decoded(name)}) {
    const std::filesystem::path path(spelling);
    for (const auto& candidate : {folder / path, folder / path.filename()}) {
      if (!std::filesystem::is_regular_file(candidate, ignored)) continue;
      if (reach.holds(candidate)) return candidate;
      outside = candidate;
    }
    for (const auto& parent : {(folder / path).parent_path(), folder}) {
      if (!reach.holds(parent)) continue;
      for (const auto& entry : std::filesystem::directory_iterator(parent, ignored)) {
        if (entry.is_regular_file(ignored) && reach.holds(entry.path()) &&
            equal_ignoring_case(entry.path().filename().string(), path.filename().string())) {
          return entry.path();
        }
      }
    }
  }
  if (outside.empty()) throw InputError("there is no such file");
  throw InputError("{} {}", outside.string(), reach.why_not());
}

/// A picture that a texture shows: in the scene's file, or one of its own.
struct Picture {
  const aiTexture* embedded = nullptr;
  std::filesystem::path path;

  /// The same for all names of one file.
  std::string key() const {
    std::error_code error;
    return embedded ? fmt::format("*{}", static_cast<const void*>(embedded))
                    : std::filesystem::weakly_canonical(path, error).string();
  }
};

Picture picture_of(const Import& import, const std::string& name) {
  if (const aiTexture* embedded = import.source.GetEmbeddedTexture(name.c_str())) return {embedded, {}};
  return {nullptr, find_picture(import.reach, name)};
}

/// Texels from a picture, or from the texture that has decoded it before. Throws InputError saying why there are none;
/// what cannot be decoded is remembered.
void set_texels(Import& import, const Picture& picture, Texture& texture) {
  const auto [first, fresh] = import.texture_of_picture.try_emplace(picture.key(), -1);
  if (!fresh) {
    if (first->second < 0) return;
    const Texture& other = import.scene.textures[static_cast<size_t>(first->second)];
    take_texels(import, other.width, other.height);
    texture.width = other.width;
    texture.height = other.height;
    texture.texels = other.texels;
    return;
  }
  if (picture.embedded) {
    decode(import, *picture.embedded, texture);
  } else {
    decode(import, read_file(picture.path, import.limits), picture.path.extension().string(), texture);
  }
  first->second = static_cast<int>(import.scene.textures.size());
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
    set_texels(import, picture_of(import, name), texture);
  } catch (const Error& error) {
    warn(fmt::format("{}: texture '{}' cannot be used ({}); a checker of magenta and black stands in",
                     import.path.string(), name, error.what()));
    texture.texels.clear();
  }
  if (texture.texels.empty()) set_placeholder(texture);
  import.scene.textures.push_back(std::move(texture));
  return entry->second;
}

}  // namespace omma::file
