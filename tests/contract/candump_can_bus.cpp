#include "drivers/candump/candump_can_bus.h"

#include <fstream>
#include <stdexcept>

#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/contract/can_bus_contract.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::test {
namespace {

std::uint8_t hex_byte(const std::string& two) {
  return static_cast<std::uint8_t>(std::stoul(two, nullptr, 16));
}

// `(0.000000) can0 123#0011`, `##1` in front of the data of an FD frame.
hal::CanFrame parse_line(const std::string& line) {
  const std::size_t id = line.find(") can0 ") + 7;
  const std::size_t hash = line.find('#');
  hal::CanFrame frame;
  frame.id = static_cast<std::uint32_t>(std::stoul(line.substr(id, hash - id), nullptr, 16));
  frame.extended = hash - id == 8;
  std::size_t data = hash + 1;
  if (line.at(hash) == '#' && data < line.size() && line[data] == '#') {
    frame.fd = true;
    frame.bit_rate_switch = line.at(data + 1) == '1';
    data += 2;
  }
  for (; data + 1 < line.size(); data += 2) {
    frame.data.at(frame.length++) = hex_byte(line.substr(data, 2));
  }
  return frame;
}

class CandumpBench final : public CanBench {
 public:
  CandumpBench() {
    auto opened = drivers::CandumpCanBus::open(path_, clock_);
    if (!opened) throw std::runtime_error(opened.error().message);
    bus_ = std::move(*opened);
    log_.open(path_);
  }

  hal::CanBus& bus() override { return *bus_; }
  Time now() const override { return clock_.now(); }
  std::vector<hal::CanFrame> heard() override {
    if (const auto flushed = bus_->flush(); !flushed) {
      throw std::runtime_error(flushed.error().message);
    }
    std::vector<hal::CanFrame> frames;
    log_.clear();
    for (std::string line; std::getline(log_, line);) frames.push_back(parse_line(line));
    return frames;
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "can.log";
  rtos::VirtualClock clock_;
  std::unique_ptr<drivers::CandumpCanBus> bus_;
  std::ifstream log_;
};

INSTANTIATE_TEST_SUITE_P(Candump, CanBusContract,
                         testing::Values(CanCase{"can_bus",
                                                 [] { return std::make_unique<CandumpBench>(); }}));

}  // namespace
}  // namespace dottrack::test
