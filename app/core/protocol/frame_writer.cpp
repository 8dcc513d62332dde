#include "app/core/protocol/frame_writer.h"

#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/e2e.h"

namespace dottrack::protocol {

void FrameWriter::write(const layout::Message& message, std::uint64_t word,
                        hal::CanFrame& frame) const {
  head(message, frame);
  word |= put(layout::status::kSequence, sequence_);
  word |= put(layout::status::kCRC, e2e::profile2_crc(word, message.data_id));
  write_word(word, frame.data.data());
}

void FrameWriter::write(const layout::Message& message, LongPayload& payload,
                        hal::CanFrame& frame) const {
  head(message, frame);
  frame.fd = true;
  frame.bit_rate_switch = true;
  put(layout::fd_pose::kSequence, sequence_, payload);
  put(layout::fd_pose::kCRC, e2e::profile5_crc(payload, message.data_id), payload);
  for (std::size_t i = 0; i < payload.size(); ++i) {
    write_word(payload[i], frame.data.data() + 8U * i);
  }
}

void FrameWriter::head(const layout::Message& message, hal::CanFrame& frame) const {
  frame.id = addressing_.base_id + message.offset;
  frame.extended = addressing_.extended;
  frame.length = static_cast<std::uint8_t>(message.length);
}

}  // namespace dottrack::protocol
