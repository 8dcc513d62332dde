#pragma once
// A vector whose capacity is part of its type. It never allocates; when it is full, try_push_back
// says so and the owner counts it.

#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <span>

namespace dottrack {

template <class T, std::size_t Capacity>
using StaticVector = boost::container::static_vector<
    T, Capacity,
    boost::container::static_vector_options_t<boost::container::throw_on_overflow<false>>>;

// Appends and returns true, or leaves a full vector as it is and returns false.
template <class T, std::size_t Capacity>
[[nodiscard]] bool try_push_back(StaticVector<T, Capacity>& v, const T& value) {
  if (v.size() == Capacity) return false;
  v.push_back(value);
  return true;
}

// Boost's iterators are not contiguous in the standard's sense, so a span has to be asked for.
template <class T, std::size_t Capacity>
std::span<const T> as_span(const StaticVector<T, Capacity>& v) {
  return {v.data(), v.size()};
}

}  // namespace dottrack
