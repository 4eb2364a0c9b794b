// WebP by libwebp.
#include <webp/decode.h>
#include <webp/demux.h>

#include <cstring>
#include <memory>

#include "omma/base/error.h"
#include "omma/image/codec/decode.h"

namespace omma {

Pixels decode_webp(std::string_view bytes, const Accept& accept) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) throw InputError("broken or truncated WebP");
  Pixels pixels;
  pixels.info.size = {features.width, features.height};
  pixels.info.components = features.has_alpha != 0 ? 4 : 3;
  pixels.info.alpha = features.has_alpha != 0 ? 3 : -1;
  accept(pixels.info);
  SampleVector<uint8_t> samples(pixels.count());
  if (features.has_animation == 0) {
    const int row = features.width * pixels.stored();
    const auto decode = features.has_alpha != 0 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (decode(data, bytes.size(), samples.data(), samples.size(), row) == nullptr) {
      throw InputError("broken or truncated WebP");
    }
    pixels.samples = std::move(samples);
    return pixels;
  }
  const WebPData whole{data, bytes.size()};
  const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> film(WebPAnimDecoderNew(&whole, nullptr),
                                                                                WebPAnimDecoderDelete);
  uint8_t* frame = nullptr;
  int time = 0;
  if (!film || WebPAnimDecoderGetNext(film.get(), &frame, &time) == 0) throw InputError("broken or truncated WebP");
  for (size_t i = 0; i * size_t(pixels.stored()) < samples.size(); ++i) {  // `frame` is RGBA
    std::memcpy(&samples[i * size_t(pixels.stored())], frame + 4 * i, size_t(pixels.stored()));
  }
  pixels.samples = std::move(samples);
  return pixels;
}

}  // namespace omma
