#include "omma/image/codec/openimageio/module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "omma/base/error.h"

namespace omma {

extern "C" void omma_openimageio_decode(std::string_view bytes, const std::string& extension, const Accept& accept,
                                        Pixels& pixels) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  OIIO::ImageSpec wishes;
  // Without this OpenImageIO multiplies colour by alpha, and the edges of leaves turn black.
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  // Readers given wishes look for the memory among them, and only there.
  OIIO::Filesystem::IOProxy* proxy = &memory;
  wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const auto input = OIIO::ImageInput::open("picture" + extension, &wishes, proxy);
  if (!input) {
    const std::string why = OIIO::geterror();
    throw InputError("{}", why.empty() ? "it is no picture of a known format" : why);
  }
  const OIIO::ImageSpec spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1) {
    throw InputError("it is {} x {} x {} with {} channels, no flat picture", spec.width, spec.height, spec.depth,
                     spec.nchannels);
  }
  pixels.info = {{spec.width, spec.height}, spec.nchannels, spec.alpha_channel};
  accept(pixels.info);
  SampleVector<uint8_t> samples(pixels.count());
  if (!input->read_image(0, 0, 0, pixels.stored(), OIIO::TypeDesc::UINT8, samples.data())) {
    throw InputError("{}", input->geterror());
  }
  pixels.samples = std::move(samples);
}

}  // namespace omma
