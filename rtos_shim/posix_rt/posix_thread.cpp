#include "rtos_shim/posix_rt/posix_thread.h"

#include <unistd.h>

#include "rtos_shim/posix_rt/system_error.h"
#include "rtos_shim/posix_rt/this_thread.h"

namespace dottrack::rtos {
namespace {

// Frees the attributes of a thread to be made.
struct Attributes {
  Attributes() { pthread_attr_init(&value); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  ~Attributes() { pthread_attr_destroy(&value); }

  pthread_attr_t value{};
};

std::size_t whole_pages(std::size_t bytes) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return (bytes + page - 1) / page * page;
}

}  // namespace

PosixThread::~PosixThread() {
  do_join();
}

Result<void> PosixThread::do_start(const ThreadSettings& settings, std::function<void()> body) {
  if (running_) return fail("thread " + settings_.name + ": is running; expected a join() first");
  settings_ = settings;
  body_ = std::move(body);
  if (auto created = create(); !created) return created;
  settled_.acquire();
  if (outcome_) return {};
  do_join();
  return outcome_;
}

void PosixThread::do_join() {
  if (!running_) return;
  pthread_join(handle_, nullptr);
  running_ = false;
  body_ = nullptr;
}

Result<void> PosixThread::create() {
  Attributes attributes;
  const std::string of = "thread " + settings_.name + ": ";
  if (pthread_attr_setstacksize(&attributes.value, whole_pages(settings_.stack_bytes)) != 0) {
    return fail(of + "no stack of " + std::to_string(settings_.stack_bytes) +
                " bytes; expected at least " + std::to_string(sysconf(_SC_THREAD_STACK_MIN)));
  }
  if (const int refused = pthread_create(&handle_, &attributes.value, enter, this); refused != 0) {
    return fail(of + "cannot be made: " + reason_of(refused) + "; expected room for a stack of " +
                std::to_string(settings_.stack_bytes) + " bytes (RLIMIT_MEMLOCK, RLIMIT_NPROC)");
  }
  running_ = true;
  return {};
}

void* PosixThread::enter(void* thread) {
  static_cast<PosixThread*>(thread)->run();
  return nullptr;
}

void PosixThread::run() {
  outcome_ = apply_to_this_thread(settings_);
  const bool ready = outcome_.has_value();
  settled_.release();
  if (ready) body_();
}

}  // namespace dottrack::rtos
