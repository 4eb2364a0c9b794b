// OpenEXR by its own library.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfThreading.h>
#include <fmt/format.h>

#include <array>
#include <cctype>
#include <new>
#include <thread>
#include <tuple>

#include "omma/base/error.h"
#include "omma/image/codec/decode.h"
#include "omma/image/codec/exr_stream.h"

namespace omma {
namespace {

struct ChannelPlace {
  std::string name, layer;
  int rank = 0;
  bool numbers = false;

  auto order() const { return std::tie(layer, rank, name); }
};

constexpr int alpha_rank = 3, other_rank = 4;

/// Of a name within its layer. Y is a grey picture's only colour, but for the second of X, Y and Z.
int rank_of(std::string name, bool has_x) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (name == "y" && !has_x) return 0;
  constexpr std::array<std::array<const char*, 2>, other_rank> names{
      {{"r", "red"}, {"g", "green"}, {"b", "blue"}, {"a", "alpha"}}};
  for (int rank = 0; rank < other_rank; ++rank) {
    if (name == names[size_t(rank)][0] || name == names[size_t(rank)][1]) return rank;
  }
  return other_rank;
}

/// R, G, B and A before everything else, and what is in no layer first.
ChannelPlace place_of(const std::string& name, const Imf::ChannelList& channels) {
  const size_t own = name.rfind('.') + 1;  // 0 where there is no dot
  const std::string layer = name.substr(0, own);
  const bool has_x = channels.findChannel(layer + "X") != nullptr;
  return {name, layer, rank_of(name.substr(own), has_x), channels[name].type == Imf::UINT};
}

std::vector<ChannelPlace> channels_of(const Imf::Header& header) {
  std::vector<ChannelPlace> places;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
      throw InputError("OpenEXR channel '{}' has a sample for {} x {} pixels; one for each pixel can be read", c.name(),
                       c.channel().xSampling, c.channel().ySampling);
    }
    places.push_back(place_of(c.name(), header.channels()));
  }
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.order() < b.order(); });
  return places;
}

template <typename T>
SampleVector<T> read_as(Imf::InputPart& part, Imf::PixelType type, const Imath::Box2i& window,
                        const std::vector<ChannelPlace>& places, const Pixels& pixels) {
  SampleVector<T> samples(pixels.count());
  const size_t step = size_t(pixels.stored()) * sizeof(T), row = size_t(pixels.info.size.width) * step;
  Imf::FrameBuffer target;
  for (int c = 0; c < pixels.stored(); ++c) {
    target.insert(places[size_t(c)].name, Imf::Slice::Make(type, samples.data() + c, window.min, pixels.info.size.width,
                                                           pixels.info.size.height, step, row));
  }
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
  return samples;
}

Pixels decode(std::string_view bytes, const Accept& accept) {
  ExrInput stream(bytes);
  Imf::MultiPartInputFile file(stream, exr_threads());
  const Imf::Header& header = file.header(0);
  if (header.hasType() && Imf::isDeepData(header.type())) {
    throw InputError("it is a deep OpenEXR picture; flat ones can be read");
  }
  const Imath::Box2i window = header.dataWindow();
  const int64_t width = int64_t{window.max.x} - window.min.x + 1, height = int64_t{window.max.y} - window.min.y + 1;
  const std::vector<ChannelPlace> places = channels_of(header);
  if (width < 1 || height < 1 || width > INT32_MAX || height > INT32_MAX || places.empty()) {
    throw InputError("broken OpenEXR header: {} x {} pixels of {} channels", width, height, places.size());
  }
  Pixels pixels;
  pixels.info.size = {static_cast<int>(width), static_cast<int>(height)};
  pixels.info.components = static_cast<int>(places.size());
  for (size_t c = 0; c < places.size() && pixels.info.alpha < 0; ++c) {
    if (places[c].rank == alpha_rank) pixels.info.alpha = static_cast<int>(c);
  }
  accept(pixels.info);
  Imf::InputPart part(file, 0);
  if (std::all_of(places.begin(), places.end(), [](const ChannelPlace& place) { return place.numbers; })) {
    pixels.samples = read_as<uint32_t>(part, Imf::UINT, window, places, pixels);
  } else {
    pixels.samples = read_as<float>(part, Imf::FLOAT, window, places, pixels);
  }
  return pixels;
}

}  // namespace

int exr_threads() {
  static const int threads = [] {
    if (Imf::globalThreadCount() == 0) Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
    return Imf::globalThreadCount();
  }();
  return threads;
}

Pixels decode_exr(std::string_view bytes, const Accept& accept) {
  try {
    return decode(bytes, accept);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {  // OpenEXR's, and its bad_alloc for a broken header
    throw InputError("broken or truncated OpenEXR file: {}", error.what());
  }
}

}  // namespace omma
