#include "app/workstation/monitor/signal_lines.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <vector>

#include "app/workstation/monitor/pose_words.h"

namespace dottrack::monitor {
namespace {

using dbc::DecodedSignal;

constexpr std::string_view kNotAvailable = "not available";

std::string text_line(const dbc::DbcMessage& message, const std::vector<DecodedSignal>& decoded) {
  std::string line = message.name;
  for (const DecodedSignal& one : decoded) {
    auto out = std::back_inserter(line);
    if (!one.text.empty()) {
      fmt::format_to(out, "  {} {}", one.signal->name, one.text);
    } else {
      fmt::format_to(out, "  {} {:.15g}{}{}", one.signal->name, one.physical,
                     one.signal->unit.empty() ? "" : " ", one.signal->unit);
    }
  }
  return line;
}

std::string json_line(const dbc::DbcMessage& message, const std::vector<DecodedSignal>& decoded) {
  std::string line = fmt::format("\"message\":\"{}\",\"signals\":{{", message.name);
  for (const DecodedSignal& one : decoded) {
    const bool known = one.text != kNotAvailable;
    fmt::format_to(std::back_inserter(line), "{}\"{}\":{}", &one == decoded.data() ? "" : ",",
                   one.signal->name, known ? fmt::format("{:.15g}", one.physical) : "null");
  }
  return line + "}";
}

}  // namespace

std::string SignalLines::line(const Arrival& arrival) const {
  hal::CanFrame frame = arrival.frame;
  const std::uint32_t offset = frame.id - addressing_.base_id;
  if (frame.extended != addressing_.extended || offset >= protocol::kIdentifiers) return {};
  frame.id = protocol::kDefaultBaseId + offset;
  frame.extended = false;
  const dbc::DbcMessage* message = layout_.find(frame.id, false);
  const std::optional<std::vector<DecodedSignal>> decoded = dbc::decode(layout_, frame);
  if (message == nullptr || !decoded) return {};
  const std::string time = seconds_text(arrival.time);
  if (format_ == Format::text) {
    return fmt::format("{} {:03X}  {}", time, arrival.frame.id, text_line(*message, *decoded));
  }
  return fmt::format("{{\"arrival_s\":{},\"id\":{},{}}}", time, arrival.frame.id,
                     json_line(*message, *decoded));
}

void SignalLines::do_frame(const Arrival& arrival) {
  const std::string text = line(arrival);
  if (!text.empty()) fmt::print(out_, "{}\n", text);
}

}  // namespace dottrack::monitor
