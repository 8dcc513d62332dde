#pragma once
// How often each grey level occurs.

#include <array>
#include <cstddef>
#include <cstdint>

namespace dottrack::exposure {

class GreyHistogram {
 public:
  void add(std::uint8_t grey_dn) {
    ++counts_[grey_dn];
    ++size_;
  }

  std::uint32_t size() const { return size_; }
  std::uint32_t at(std::uint8_t grey_dn) const { return counts_[grey_dn]; }

  // The grey level that this share of the pixels does not exceed; 0 of an empty one.
  int percentile_dn(double share) const {
    const double rank = share * size_;
    std::uint32_t below = 0;
    for (std::size_t dn = 0; dn < counts_.size(); ++dn) {
      below += counts_[dn];
      if (size_ > 0 && below >= rank && below > 0) return static_cast<int>(dn);
    }
    return 0;
  }

  double mean_dn() const {
    if (size_ == 0) return 0.0;
    std::uint64_t sum = 0;
    for (std::size_t dn = 0; dn < counts_.size(); ++dn) sum += dn * counts_[dn];
    return static_cast<double>(sum) / size_;
  }

 private:
  std::array<std::uint32_t, 256> counts_{};
  std::uint32_t size_ = 0;
};

}  // namespace dottrack::exposure
