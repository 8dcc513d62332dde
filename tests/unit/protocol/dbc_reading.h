#pragma once
// What a tool that has dottrack.dbc and nothing else of ours shows of a group of frames.

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>

#include "app/workstation/dbc/dbc_file.h"
#include "app/workstation/dbc/dottrack_dbc.h"

namespace dottrack::protocol::test {

inline const dbc::DbcFile& layout_file() {
  static const dbc::DbcFile file = [] {
    auto parsed = dbc::parse_dbc(dbc::dottrack_dbc(), "dottrack.dbc");
    if (!parsed) throw std::runtime_error(parsed.error().message);
    return *parsed;
  }();
  return file;
}

inline const dbc::DbcMessage& layout_of(const std::string& message) {
  const dbc::DbcMessage* found = layout_file().find("DOTTRACK_" + message);
  if (found == nullptr) throw std::runtime_error("no message " + message);
  return *found;
}

// Signals by "Message.Signal", the message without its prefix.
class Reading {
 public:
  Reading() = default;
  template <class Frames>
  explicit Reading(const Frames& frames) {
    for (const hal::CanFrame& frame : frames) add(frame);
  }

  // Frames of the default base identifier, 11 bits.
  void add(const hal::CanFrame& frame) {
    const dbc::DbcMessage* message = layout_file().find(frame.id, frame.extended);
    if (message == nullptr) throw std::runtime_error("a frame that the DBC does not know");
    if (frame.length != message->length_bytes) throw std::runtime_error("length of a frame");
    const std::string name = message->name.substr(std::string("DOTTRACK_").size()) + ".";
    for (const dbc::DecodedSignal& signal : dbc::decode(*message, frame.payload())) {
      signals_[name + signal.signal->name] = signal;
    }
  }

  const dbc::DecodedSignal& at(const std::string& name) const {
    const auto found = signals_.find(name);
    if (found == signals_.end()) throw std::runtime_error("not among the frames: " + name);
    return found->second;
  }
  double operator()(const std::string& name) const { return at(name).physical; }
  std::int64_t raw(const std::string& name) const { return at(name).raw; }
  bool available(const std::string& name) const { return at(name).text != "not available"; }
  const std::map<std::string, dbc::DecodedSignal>& signals() const { return signals_; }

 private:
  std::map<std::string, dbc::DecodedSignal> signals_;
};

}  // namespace dottrack::protocol::test
