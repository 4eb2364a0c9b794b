// OpenEXR by its own library.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include "omma/image/codec/encode.h"
#include "omma/image/codec/exr_stream.h"

namespace omma {

std::string encode_exr(const ExrPicture& picture) {
  Imf::Header header(picture.size.width, picture.size.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  if (picture.latlong) Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  const Imf::PixelType type = picture.type == ExrType::float32 ? Imf::FLOAT : Imf::UINT;
  constexpr size_t sample = 4;
  const size_t step = sample * picture.channels.size(), row = step * size_t(picture.size.width);
  Imf::FrameBuffer source;
  for (size_t c = 0; c < picture.channels.size(); ++c) {
    header.channels().insert(picture.channels[c], Imf::Channel(type));
    // OpenEXR takes what it reads for what it might write.
    char* first = static_cast<char*>(const_cast<void*>(picture.samples)) + c * sample;
    source.insert(picture.channels[c], Imf::Slice(type, first, step, row));
  }
  ExrOutput stream;
  {
    Imf::OutputFile file(stream, header, exr_threads());
    file.setFrameBuffer(source);
    file.writePixels(picture.size.height);
  }  // writes the table of lines
  return stream.take();
}

}  // namespace omma
