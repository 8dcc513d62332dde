#include "app/workstation/monitor/command_exchange.h"
#include "app/core/protocol/receiver_frame.h"

#include <thread>

namespace dottrack::monitor {
namespace {

constexpr Duration kPause = std::chrono::milliseconds(1);
constexpr Duration kSendPatience = std::chrono::milliseconds(200);
constexpr std::uint8_t kRepeated = 1;  // result of a reply

class Exchange {
 public:
  Exchange(hal::CanBus& bus, const rtos::Clock& clock, const dottrack_settings& settings)
      : bus_(bus), clock_(clock), settings_(settings) {
    dottrack_receiver_init(&receiver_, &settings_);
  }

  bool send(const CommandRequest& request) {
    const dottrack_frame made = dottrack_command_frame(
        &settings_, request.command, request.argument, request.token, request.sequence);
    return bus_.send(protocol::from_receiver(made), clock_.now() + kSendPatience) ==
           hal::SendResult::accepted;
  }

  CommandAnswer wait(const CommandRequest& request) {
    CommandAnswer answer;
    const Time end = clock_.now() + request.patience;
    while (clock_.now() < end && !complete(request, answer)) {
      hal::CanFrame frame;
      if (bus_.receive(frame)) {
        take(protocol::to_receiver(frame), request.token, answer);
      } else {
        std::this_thread::sleep_for(kPause);
      }
    }
    answer.unit = receiver_.unit;
    return answer;
  }

 private:
  void take(const dottrack_frame& frame, std::uint16_t token, CommandAnswer& answer) {
    dottrack_reply reply{};
    if (dottrack_read_reply(&settings_, &frame, &reply) && reply.token == token) {
      answer.reply = reply;
    }
    dottrack_pose unused{};
    dottrack_receiver_push(&receiver_, &frame, 0, &unused);
  }

  bool complete(const CommandRequest& request, const CommandAnswer& answer) const {
    if (!answer.reply) return false;
    const bool more =
        request.command == DOTTRACK_COMMAND_REPORT_VERSION && answer.reply->result == 0;
    return !more || (receiver_.unit.has_version && receiver_.unit.has_configuration);
  }

  hal::CanBus& bus_;
  const rtos::Clock& clock_;
  dottrack_settings settings_;
  dottrack_receiver receiver_{};
};

}  // namespace

Result<CommandAnswer> exchange(hal::CanBus& bus, const rtos::Clock& clock,
                               const dottrack_settings& settings, const CommandRequest& request) {
  Exchange run(bus, clock, settings);
  if (!run.send(request)) return fail("the bus does not take the command: down, off or full");
  CommandAnswer answer = run.wait(request);
  if (!answer.reply || answer.reply->result != kRepeated) return answer;
  CommandRequest again = request;
  ++again.token;
  ++again.sequence;
  if (!run.send(again)) return fail("the bus does not take the command: down, off or full");
  return run.wait(again);
}

}  // namespace dottrack::monitor
