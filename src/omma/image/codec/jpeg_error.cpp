#include "omma/image/codec/jpeg_error.h"

namespace omma {
namespace {

[[noreturn]] void leave(j_common_ptr jpeg) {
  auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
  jpeg->err->format_message(jpeg, errors->message);
  std::longjmp(errors->out, 1);
}

/// libjpeg takes data that ends too early for a warning and draws the rest in grey.
void on_message(j_common_ptr jpeg, int level) {
  if (level < 0 && (jpeg->err->msg_code == JWRN_JPEG_EOF || jpeg->err->msg_code == JWRN_HIT_MARKER)) leave(jpeg);
}

void say_nothing(j_common_ptr) {}

}  // namespace

jpeg_error_mgr* prepare(JpegErrors& errors) {
  jpeg_error_mgr* manager = jpeg_std_error(&errors.manager);
  manager->error_exit = leave;
  manager->emit_message = on_message;
  manager->output_message = say_nothing;
  return manager;
}

}  // namespace omma
