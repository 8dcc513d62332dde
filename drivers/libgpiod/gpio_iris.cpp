#include "drivers/libgpiod/gpio_iris.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "drivers/libgpiod/iris_banks.h"
#include "drivers/libgpiod/iris_mailbox.h"

namespace dottrack::drivers {
namespace {

constexpr double kFastest_steps_per_s = 100'000.0;
constexpr int kLongestTravel_steps = 1'000'000;
constexpr Duration kNothingToStep = std::chrono::milliseconds(100);

Result<void> check(const IrisWiring& iris) {
  const std::string where = iris.name + ": iris on GPIO chip " + iris.chip + ": ";
  if (iris.travel_steps < 1 || iris.travel_steps > kLongestTravel_steps) {
    return fail(where + "a travel of " + std::to_string(iris.travel_steps) +
                " steps; expected 1 to 1000000");
  }
  if (!(iris.steps_per_s > 0.0 && iris.steps_per_s <= kFastest_steps_per_s)) {
    return fail(where + std::to_string(iris.steps_per_s) +
                " steps a second; expected more than 0 and at most 100000");
  }
  if (iris.backlash_steps < 0 || iris.backlash_steps > kLongestTravel_steps) {
    return fail(where + "a backlash of " + std::to_string(iris.backlash_steps) +
                " steps; expected 0 to 1000000");
  }
  const auto [low, high] = iris.limits;
  if (low >= 0.0 && low <= high && high <= 1.0) return {};
  return fail(where + "limits " + std::to_string(low) + " and " + std::to_string(high) +
              "; expected 0 <= narrowest <= widest <= 1");
}

MotorSettings settings_of(const IrisWiring& iris) {
  return {.travel_steps = iris.travel_steps,
          .step_period = Duration(static_cast<Duration::rep>(std::ceil(1e9 / iris.steps_per_s))),
          .backlash_steps = iris.backlash_steps,
          .has_end_stop = iris.end_stop_line.has_value(),
          .has_auto_iris = iris.auto_line.has_value()};
}

IrisMailbox::Status status_of(const IrisMotor& motor) {
  return {motor.position_steps(), motor.phase()};
}

// One iris: its motor, whose thread calls advance(), and what it shares with other threads.
struct Axis {
  Axis(const IrisWiring& iris, const IrisLines& its_lines, Time start)
      : lines(its_lines), settings(settings_of(iris)), limits(iris.limits), motor(settings, start) {
    mailbox.answer(0, status_of(motor));
  }

  int steps_for(double opening) const {
    const double within = std::clamp(opening, limits[0], limits[1]);
    return static_cast<int>(std::lround(within * settings.travel_steps));
  }

  IrisLines lines;
  MotorSettings settings;
  std::array<double, 2> limits;
  IrisMotor motor;
  IrisMailbox mailbox;
  IrisMailbox::Numbered request;
  std::atomic<std::uint64_t> steps{0};
};

struct Bank {
  std::unique_ptr<LineBank> lines;
  std::uint64_t wanted = 0;
  std::uint64_t written = 0;
  std::uint64_t inputs = 0;
  bool busy = false;          // a motor of it has something to do
  bool needs_inputs = false;  // and an end stop to look at
  bool blind = false;         // they cannot be read
  bool stuck = false;         // its outputs cannot be driven
};

std::uint64_t bits_of(const MotorPins& pins, const IrisLines& lines) {
  return (pins.step ? lines.step : 0) | (pins.opening ? lines.direction : 0) |
         (pins.enable ? lines.enable : 0) | (pins.override_auto ? lines.override_auto : 0);
}

std::uint64_t all_bits(const IrisLines& lines) {
  return lines.step | lines.direction | lines.enable | lines.override_auto;
}

}  // namespace

class GpioIris::Motors {
 public:
  Motors(const std::vector<std::optional<IrisWiring>>& irises, IrisBanks taken, Time start) {
    for (std::unique_ptr<LineBank>& lines : taken.banks) banks_.push_back({std::move(lines)});
    for (std::size_t i = 0; i < irises.size(); ++i) {
      axes_.push_back(irises[i] ? std::make_unique<Axis>(*irises[i], *taken.irises[i], start)
                                : nullptr);
    }
  }

  ~Motors() {
    for (Bank& bank : banks_) bank.lines->set(~std::uint64_t{0}, 0);
  }

  Motors(const Motors&) = delete;
  Motors& operator=(const Motors&) = delete;

  Axis* axis(std::size_t camera) const {
    return camera < axes_.size() ? axes_[camera].get() : nullptr;
  }

  Duration fastest_step() const {
    Duration fastest = Duration::max();
    for (const auto& axis : axes_) {
      if (axis) fastest = std::min(fastest, axis->settings.step_period);
    }
    return fastest;
  }

  void advance(Time now) {
    take_requests();
    for (Bank& bank : banks_) read(bank);
    for (const auto& axis : axes_) {
      if (axis) step(*axis, now);
    }
    for (Bank& bank : banks_) write(bank);
    for (const auto& axis : axes_) {
      if (axis) answer(*axis);
    }
  }

 private:
  void take_requests() {
    for (Bank& bank : banks_) bank.busy = bank.needs_inputs = bank.blind = bank.stuck = false;
    for (const auto& axis : axes_) {
      if (!axis) continue;
      const IrisMailbox::Numbered newest = axis->mailbox.newest();
      const bool busy = !axis->motor.idle() || newest.number != axis->request.number;
      Bank& bank = banks_[axis->lines.bank];
      bank.busy = bank.busy || busy;
      bank.needs_inputs = bank.needs_inputs || (busy && axis->settings.has_end_stop);
      axis->request = newest;
    }
  }

  static void read(Bank& bank) {
    if (!bank.needs_inputs) return;
    const std::optional<std::uint64_t> inputs = bank.lines->inputs();
    bank.blind = !inputs;
    bank.inputs = inputs.value_or(0);
  }

  void step(Axis& axis, Time now) {
    Bank& bank = banks_[axis.lines.bank];
    if (!bank.busy) return;
    if (bank.blind && axis.settings.has_end_stop) axis.motor.lose();
    const bool end_stop = (bank.inputs & axis.lines.end_stop) != 0;
    const MotorPins pins = axis.motor.advance(now, axis.request.request, end_stop);
    bank.wanted = (bank.wanted & ~all_bits(axis.lines)) | bits_of(pins, axis.lines);
  }

  static void write(Bank& bank) {
    if (bank.wanted == bank.written) return;
    if (bank.lines->set(bank.wanted ^ bank.written, bank.wanted)) {
      bank.written = bank.wanted;
    } else {
      bank.stuck = true;
    }
  }

  void answer(Axis& axis) {
    if (banks_[axis.lines.bank].stuck) axis.motor.lose();
    axis.steps.store(axis.motor.steps(), std::memory_order_relaxed);
    axis.mailbox.answer(axis.request.number, status_of(axis.motor));
  }

  std::vector<Bank> banks_;
  std::vector<std::unique_ptr<Axis>> axes_;  // one a camera
};

Result<std::unique_ptr<GpioIris>> GpioIris::open(std::vector<std::optional<IrisWiring>> irises,
                                                 const rtos::Clock& clock) {
  return open(std::move(irises), clock, kernel_line_banks());
}

Result<std::unique_ptr<GpioIris>> GpioIris::open(std::vector<std::optional<IrisWiring>> irises,
                                                 const rtos::Clock& clock, LineBanks& banks) {
  for (const std::optional<IrisWiring>& iris : irises) {
    if (!iris) continue;
    if (Result<void> sound = check(*iris); !sound) return tl::unexpected(std::move(sound.error()));
  }
  Result<IrisBanks> taken = request_iris_lines(irises, banks);
  if (!taken) return tl::unexpected(std::move(taken.error()));
  return std::unique_ptr<GpioIris>(
      new GpioIris(std::make_unique<Motors>(irises, *std::move(taken), clock.now())));
}

GpioIris::GpioIris(std::unique_ptr<Motors> motors) : motors_(std::move(motors)) {}

GpioIris::~GpioIris() = default;

Duration GpioIris::step_period() const {
  const Duration fastest = motors_->fastest_step();
  return fastest == Duration::max() ? kNothingToStep : (fastest + Duration(1)) / 2 + fastest / 100;
}

void GpioIris::advance(Time now) {
  motors_->advance(now);
}

std::uint64_t GpioIris::steps(std::size_t camera) const {
  const Axis* axis = motors_->axis(camera);
  return axis == nullptr ? 0 : axis->steps.load(std::memory_order_relaxed);
}

bool GpioIris::do_move_to(std::size_t camera, double opening) {
  Axis* axis = motors_->axis(camera);
  if (axis == nullptr || !std::isfinite(opening)) return false;
  axis->mailbox.ask(axis->steps_for(opening));
  return true;
}

bool GpioIris::do_release_to_auto(std::size_t camera) {
  Axis* axis = motors_->axis(camera);
  if (axis == nullptr) return false;
  axis->mailbox.ask(std::nullopt);
  return true;
}

hal::IrisState GpioIris::do_state(std::size_t camera) const {
  const Axis* axis = motors_->axis(camera);
  if (axis == nullptr) return {};
  const IrisMailbox::View view = axis->mailbox.view();
  const MotorPhase phase = view.status.phase;
  const bool stepping = phase == MotorPhase::homing || phase == MotorPhase::moving;
  hal::IrisState state;
  state.opening = std::clamp(
      static_cast<double>(view.status.position_steps) / axis->settings.travel_steps, 0.0, 1.0);
  state.automatic = !view.request.target_steps.has_value();
  state.moving = !state.automatic && (stepping || !view.answered);
  state.healthy = phase != MotorPhase::faulty;
  return state;
}

}  // namespace dottrack::drivers
