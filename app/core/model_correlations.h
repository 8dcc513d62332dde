#pragma once
// How the errors of several cameras' models go together: models of one calibration rest on the same
// survey and the same dots, and are wrong together.

#include <array>
#include <cstddef>

#include "app/core/limits.h"

namespace dottrack::core {

// One of a camera's model errors (Camera::model_errors).
struct ModelErrorIndex {
  std::size_t camera = 0;
  std::size_t error = 0;
};

// Correlations of the errors of different cameras; those of one camera are independent of each
// other. Nothing is known: every camera's errors are its own.
class ModelCorrelations {
 public:
  bool known() const { return known_; }

  double operator()(const ModelErrorIndex& a, const ModelErrorIndex& b) const {
    return static_cast<double>(of_[row(a)][row(b)]);
  }
  void set(const ModelErrorIndex& a, const ModelErrorIndex& b, double correlation) {
    of_[row(a)][row(b)] = of_[row(b)][row(a)] = static_cast<float>(correlation);
    known_ = true;
  }

 private:
  static constexpr std::size_t kRows = kMaxCameras * kMaxModelErrors;

  static std::size_t row(const ModelErrorIndex& i) { return i.camera * kMaxModelErrors + i.error; }

  bool known_ = false;
  std::array<std::array<float, kRows>, kRows> of_{};
};

}  // namespace dottrack::core
