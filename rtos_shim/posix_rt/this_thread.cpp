#include "rtos_shim/posix_rt/this_thread.h"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "rtos_shim/posix_rt/stack.h"
#include "rtos_shim/posix_rt/system_error.h"

namespace dottrack::rtos {
namespace {

constexpr std::size_t kMaxNameLength = 15;

tl::unexpected<Error> fail_in(const ThreadSettings& settings, const std::string& what) {
  return fail("thread " + settings.name + ": " + what);
}

Result<void> take_name(const ThreadSettings& settings) {
  const std::string& name = settings.name;
  if (name.size() > kMaxNameLength) {
    return fail_in(settings, "its name has " + std::to_string(name.size()) +
                                 " characters; expected at most " + std::to_string(kMaxNameLength));
  }
  pthread_setname_np(pthread_self(), name.c_str());
  std::array<char, kMaxNameLength + 1> taken{};
  pthread_getname_np(pthread_self(), taken.data(), taken.size());
  if (name != taken.data()) return fail_in(settings, "the kernel did not take its name");
  return {};
}

cpu_set_t cpus_of(pid_t task) {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  sched_getaffinity(task, sizeof cpus, &cpus);
  return cpus;
}

Result<void> take_cpu(const ThreadSettings& settings) {
  cpu_set_t wanted = cpus_of(getpid());
  if (settings.cpu) {
    CPU_ZERO(&wanted);
    if (*settings.cpu >= 0 && *settings.cpu < CPU_SETSIZE) {
      CPU_SET(static_cast<std::size_t>(*settings.cpu), &wanted);
    }
  }
  const bool accepted = sched_setaffinity(0, sizeof wanted, &wanted) == 0;
  const cpu_set_t taken = cpus_of(0);
  if (accepted && CPU_EQUAL(&wanted, &taken)) return {};
  if (!settings.cpu) return fail_in(settings, "cannot run on the processors of its program");
  return fail_in(settings, "cannot run on cpu " + std::to_string(*settings.cpu) +
                               "; expected one that is there and that this program may use");
}

Result<void> check_priority(const ThreadSettings& settings) {
  const int lowest = sched_get_priority_min(SCHED_FIFO);
  const int highest = sched_get_priority_max(SCHED_FIFO);
  const int wanted = settings.fifo_priority.value_or(lowest);
  if (wanted >= lowest && wanted <= highest) return {};
  return fail_in(settings, "no real-time priority " + std::to_string(wanted) + "; expected " +
                               std::to_string(lowest) + " to " + std::to_string(highest));
}

Result<void> take_priority(const ThreadSettings& settings) {
  if (auto checked = check_priority(settings); !checked) return checked;
  const int policy = settings.fifo_priority ? SCHED_FIFO : SCHED_OTHER;
  sched_param wanted{};
  wanted.sched_priority = settings.fifo_priority.value_or(0);
  const int refused = pthread_setschedparam(pthread_self(), policy, &wanted);
  const std::string priority = "real-time priority " + std::to_string(wanted.sched_priority);
  if (refused == EPERM) {
    return fail_in(settings, "no permission for " + priority +
                                 "; expected RLIMIT_RTPRIO of at least " +
                                 std::to_string(wanted.sched_priority) + " or CAP_SYS_NICE");
  }
  if (refused != 0) return fail_in(settings, "cannot have " + priority + ": " + reason_of(refused));
  int policy_taken = -1;
  sched_param taken{};
  pthread_getschedparam(pthread_self(), &policy_taken, &taken);
  if (policy_taken == policy && taken.sched_priority == wanted.sched_priority) return {};
  return fail_in(settings, "the kernel did not take " + priority);
}

}  // namespace

Result<void> apply_to_this_thread(const ThreadSettings& settings) {
  if (auto taken = take_name(settings); !taken) return taken;
  if (auto taken = take_cpu(settings); !taken) return taken;
  if (auto taken = take_priority(settings); !taken) return taken;
  touch_stack(stack_left_bytes());
  return {};
}

}  // namespace dottrack::rtos
