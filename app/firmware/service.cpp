#include "app/firmware/service.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/syscall.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "app/config/rig_file.h"
#include "app/firmware/continuity.h"
#include "app/firmware/exit_status.h"
#include "app/firmware/housekeeping.h"
#include "app/firmware/journal.h"
#include "app/firmware/measure.h"
#include "app/firmware/unit.h"
#include "rtos_shim/posix_rt/device_watchdog.h"
#include "rtos_shim/posix_rt/posix_memory_lock.h"

namespace dottrack::firmware {
namespace {

using telemetry::Severity;

constexpr std::size_t kMainStack_bytes = 128 * 1024;

// Blocked in every thread, and waited for by this one.
class Signals {
 public:
  Signals() {
    sigemptyset(&set_);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1}) sigaddset(&set_, signal);
    pthread_sigmask(SIG_BLOCK, &set_, nullptr);
  }

  // The next one; nothing when a limit of seconds is over before.
  std::optional<int> wait(std::optional<double> limit_s) {
    timespec limit{};
    if (limit_s) {
      limit.tv_sec = static_cast<time_t>(*limit_s);
      limit.tv_nsec = static_cast<long>((*limit_s - static_cast<double>(limit.tv_sec)) * 1e9);
    }
    int signal = -1;
    do {
      signal = limit_s ? sigtimedwait(&set_, nullptr, &limit) : sigwaitinfo(&set_, nullptr);
    } while (signal < 0 && errno == EINTR);
    return signal < 0 ? std::nullopt : std::optional(signal);
  }

 private:
  sigset_t set_{};
};

class Service {
 public:
  explicit Service(const ServiceOptions& options)
      : options_(options),
        degradation_(options.allow_degraded),
        locks_(ContinuityFile::of_service()) {}

  int run() {
    Result<config::RigConfig> config = config::load_rig(options_.config);
    if (!config) return give_up(config.error(), kWrongUse);
    log_warnings(config->warnings);
    if (auto done = prepare(); !done) return give_up(done.error(), kFailed);
    if (auto done = start(*config); !done) return give_up(done.error(), kFailed);
    manager_.ready();
    log_line(Severity::info,
             fmt::format("{}: {} cameras at {} Hz on {}; {}", config->name, config->cameras.size(),
                         config->frame_rate_hz, config->unit.can.interface,
                         config::describe(config::can_use(*config))));
    const bool kept_running = serve();
    finish();
    return kept_running ? kDone : kFailed;
  }

 private:
  // What holds for the process, whatever the configuration later on.
  Result<void> prepare() {
    rtos::PosixMemoryLock memory;
    if (auto locked = memory.lock_all(kMainStack_bytes);
        !locked && !degradation_.accepts(locked.error())) {
      return locked;
    }
    if (auto resets = locks_.resets_at_start()) {
      continuity_.resets = *resets;
    } else {
      log_line(Severity::warning, resets.error().message);
    }
    return {};
  }

  // Armed from here on: only once the devices are open, which may take its time.
  Result<void> open_watchdog(const config::LoopConfig& loop) {
    if (watchdog_ || loop.watchdog.empty()) return {};
    const auto timeout =
        std::chrono::duration_cast<Duration>(std::chrono::duration<double>(loop.watchdog_s));
    auto watchdog = rtos::DeviceWatchdog::open(loop.watchdog, timeout);
    if (watchdog) {
      watchdog_ = std::move(*watchdog);
    } else if (!degradation_.accepts(watchdog.error())) {
      return tl::unexpected<Error>(watchdog.error());
    }
    return {};
  }

  Result<void> start(const config::RigConfig& config) {
    auto unit = Unit::open(config, degradation_);
    if (!unit) return tl::unexpected<Error>(unit.error());
    unit_ = std::move(*unit);
    measure_ = std::make_unique<Measure>();
    housekeeping_ = std::make_unique<Housekeeping>(*unit_, manager_, degradation_, locks_,
                                                   options_.measure_s ? measure_.get() : nullptr);
    if (auto done = open_watchdog(config.unit.loop); !done) return done;
    if (auto done = unit_->start(watchdog_.get(), continuity_, degradation_); !done) return done;
    return housekeeping_->start();
  }

  void end_unit() {
    if (unit_) {
      unit_->stop();
      continuity_ = unit_->continuity();
      if (auto kept = locks_.keep(continuity_.resets); !kept) {
        log_line(Severity::warning, kept.error().message);
      }
    }
    housekeeping_.reset();
    if (watchdog_) watchdog_->kick();
  }

  // Until a signal ends it or there is nothing left to run.
  bool serve() {
    while (unit_) {
      const std::optional<int> signal = signals_.wait(options_.measure_s);
      if (signal == SIGUSR1) {
        set_target();
        continue;
      }
      if (signal != SIGHUP) return true;
      manager_.reloading();
      reload();
      manager_.ready();
    }
    return false;
  }

  // As a command over CAN asked for.
  void set_target() {
    const std::optional<std::uint8_t> index = unit_->requests().take_target();
    const config::RigConfig& config = unit_->config();
    if (!index || *index >= config.targets.size() || *index == config.target_index) return;
    unit_->exchange(config::with_target(config, *index));
    log_line(Severity::info, fmt::format("target {} from now on, by a command over CAN",
                                         unit_->config().target_name));
  }

  void reload() {
    Result<config::RigConfig> config = config::load_rig(options_.config);
    if (!config) return keep(config.error());
    log_warnings(config->warnings);
    if (unit_->takes(*config)) {
      unit_->exchange(std::move(*config));
      log_line(Severity::info, "the new configuration is in force");
      return;
    }
    restart(*config);
  }

  void keep(const Error& error) {
    log_line(Severity::error, fmt::format("{}; the configuration stays as it was", error.message));
  }

  // Other devices, or the same ones otherwise: they are closed and opened anew.
  void restart(const config::RigConfig& wanted) {
    const config::RigConfig before = unit_->config();
    end_unit();
    unit_.reset();
    if (auto done = start(wanted)) {
      log_line(Severity::info, "the new configuration is in force, with its devices opened anew");
      return;
    } else {
      keep(done.error());
    }
    end_unit();
    unit_.reset();
    if (auto done = start(before); !done) {
      log_line(Severity::error, done.error().message);
      end_unit();
      unit_.reset();
    }
  }

  void finish() {
    manager_.stopping();
    end_unit();
    if (options_.measure_s && unit_) {
      std::fputs(measure_->report(unit_->heap_calls()).c_str(), stdout);
    }
    unit_.reset();
    if (watchdog_) watchdog_->disarm();
    log_line(Severity::info, "ended");
  }

  int give_up(const Error& error, int status) {
    log_line(Severity::error, error.message);
    end_unit();
    unit_.reset();
    if (watchdog_) watchdog_->disarm();
    return status;
  }

  ServiceOptions options_;
  Signals signals_;  // before any thread starts
  rtos::ServiceManager manager_;
  Degradation degradation_;
  ContinuityFile locks_;
  Continuity continuity_;
  std::unique_ptr<rtos::DeviceWatchdog> watchdog_;
  std::unique_ptr<Measure> measure_;
  std::unique_ptr<Unit> unit_;
  std::unique_ptr<Housekeeping> housekeeping_;  // knows the unit: goes before it
};

}  // namespace

int run_service(const ServiceOptions& options) {
  return Service(options).run();
}

}  // namespace dottrack::firmware
