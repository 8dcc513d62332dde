#include "drivers/libcamera/luma.h"

// jpeglib.h needs cstdio and cstddef before it
#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

#include <jerror.h>

namespace dottrack::drivers {

void copy_yuyv_luma(std::span<const std::uint8_t> yuyv, std::ptrdiff_t stride_bytes, int width_px,
                    int height_px, std::span<std::uint8_t> grey) {
  std::uint8_t* to = grey.data();
  for (int y = 0; y < height_px; ++y) {
    const std::uint8_t* from = yuyv.data() + y * stride_bytes;
    for (int x = 0; x < width_px; ++x) *to++ = from[2 * x];
  }
}

// The library reports by callbacks that may not return; it is plain C, so longjmp is the way out.
struct JpegLuma::Decoder {
  jpeg_error_mgr errors{};  // first: the library hands it back as a pointer to this struct
  jmp_buf out{};
  bool damaged = false;
  jpeg_decompress_struct picture{};

  static Decoder& of(j_common_ptr picture) { return *reinterpret_cast<Decoder*>(picture->err); }

  [[noreturn]] static void on_error(j_common_ptr picture) { std::longjmp(of(picture).out, 1); }

  // Below zero: the data is damaged, and a picture is made up from what there is.
  static void on_message(j_common_ptr picture, int level) {
    const bool harmless = picture->err->msg_code == JWRN_EXTRANEOUS_DATA;
    if (level < 0 && !harmless) of(picture).damaged = true;
  }

  bool read_rows(int width_px, int height_px, std::uint8_t* row);
};

JpegLuma::JpegLuma() : decoder_(std::make_unique<Decoder>()) {
  decoder_->picture.err = jpeg_std_error(&decoder_->errors);
  decoder_->errors.error_exit = &Decoder::on_error;
  decoder_->errors.emit_message = &Decoder::on_message;
  if (setjmp(decoder_->out) == 0) jpeg_create_decompress(&decoder_->picture);
}

JpegLuma::~JpegLuma() {
  jpeg_destroy_decompress(&decoder_->picture);
}

bool JpegLuma::Decoder::read_rows(int width_px, int height_px, std::uint8_t* row) {
  if (jpeg_read_header(&picture, TRUE) != JPEG_HEADER_OK) return false;
  const bool same_size = picture.image_width == static_cast<JDIMENSION>(width_px) &&
                         picture.image_height == static_cast<JDIMENSION>(height_px);
  if (!same_size) return false;
  picture.out_color_space = JCS_GRAYSCALE;
  jpeg_start_decompress(&picture);
  for (int y = 0; y < height_px; ++y, row += width_px) {
    JSAMPROW rows[] = {row};
    jpeg_read_scanlines(&picture, rows, 1);
  }
  jpeg_finish_decompress(&picture);
  return !damaged;
}

bool JpegLuma::decode(std::span<const std::uint8_t> jpeg, int width_px, int height_px,
                      std::span<std::uint8_t> grey) {
  Decoder& decoder = *decoder_;
  decoder.damaged = false;
  // Between here and the callbacks there is no object with a destructor.
  if (setjmp(decoder.out) != 0) {
    jpeg_abort_decompress(&decoder.picture);
    return false;
  }
  jpeg_mem_src(&decoder.picture, jpeg.data(), jpeg.size());
  const bool whole = decoder.read_rows(width_px, height_px, grey.data());
  jpeg_abort_decompress(&decoder.picture);
  return whole;
}

}  // namespace dottrack::drivers
