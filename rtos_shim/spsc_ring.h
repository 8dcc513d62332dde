#pragma once
// A queue between exactly one producing and one consuming thread, without locks.

#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>

namespace dottrack::rtos {

// Holds up to Capacity elements inside the object itself. Neither side waits, blocks or allocates
// (as long as copying a T does not).
template <class T, std::size_t Capacity>
class SpscRing {
 public:
  // The producer's side: false when the ring is full; the element is then not taken.
  [[nodiscard]] bool try_push(const T& value) { return queue_.push(value); }
  // The consumer's side: false when the ring is empty; `value` is then as it was.
  [[nodiscard]] bool try_pop(T& value) { return queue_.pop(value); }

  static constexpr std::size_t capacity() { return Capacity; }

 private:
  boost::lockfree::spsc_queue<T, boost::lockfree::capacity<Capacity>> queue_;
};

}  // namespace dottrack::rtos
