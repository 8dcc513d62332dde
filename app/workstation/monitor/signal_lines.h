#pragma once
// Every frame with every signal by name, as dottrack.dbc has them.

#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "app/core/protocol/addressing.h"
#include "app/workstation/dbc/dbc_file.h"
#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

class SignalLines final : public Writer {
 public:
  enum class Format : std::uint8_t { text, json };

  // `layout`: messages from the default base identifier on.
  SignalLines(std::FILE* out, dbc::DbcFile layout, const protocol::Addressing& addressing,
              Format format)
      : out_(out), layout_(std::move(layout)), addressing_(addressing), format_(format) {}

  // Without a line's end; empty for a frame without a message in the layout.
  std::string line(const Arrival& arrival) const;

 private:
  void do_frame(const Arrival& arrival) override;

  std::FILE* out_;
  dbc::DbcFile layout_;
  protocol::Addressing addressing_;
  Format format_;
};

}  // namespace dottrack::monitor
