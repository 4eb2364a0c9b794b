// libjpeg says that something is wrong by a function that must not return: errors leave by longjmp, over frames of C
// and of `guarded` alone, and become exceptions there.
#pragma once

#include <csetjmp>
#include <cstdio>
#include <string>
//
#include <jerror.h>
#include <jpeglib.h>

namespace omma {

struct JpegErrors {
  jpeg_error_mgr manager;  ///< first, so that its address is that of the whole
  std::jmp_buf out;
  char message[JMSG_LENGTH_MAX];
};

/// The error manager to put into libjpeg's object.
jpeg_error_mgr* prepare(JpegErrors& errors);

/// Calls `work`, which owns nothing that needs a destructor. Returns what went wrong; empty when all went well.
template <typename Work>
std::string guarded(JpegErrors& errors, const Work& work) {
  if (setjmp(errors.out) != 0) return errors.message;
  work();
  return {};
}

}  // namespace omma
