#include "app/core/estimation/lasting_share.h"

#include <algorithm>

namespace dottrack::estimation {
namespace {

constexpr double kKept = 0.7;  // a tick: a vehicle that drives off changes everything
constexpr double kMost = 0.95;
constexpr double kChance = 4.0;  // squared correlation over its variance: less is nothing

}  // namespace

void LastingShare::take_in(std::span<const ViewResidual> residuals) {
  LastOfAll now;
  lasting_ *= kKept;
  whole_ *= kKept;
  chance_ *= kKept * kKept;
  for (const ViewResidual& residual : residuals) {
    const Last& last = last_[residual.camera][residual.dot];
    now[residual.camera][residual.dot] = {true, residual.of};
    if (!last.known) continue;
    const double product = residual.of.dot(last.residual);
    lasting_ += product;
    chance_ += product * product;
    whole_ += 0.5 * (residual.of.squaredNorm() + last.residual.squaredNorm());
  }
  last_ = now;
}

double LastingShare::value() const {
  const double by_chance = kChance * chance_;
  if (!(lasting_ > 0.0) || lasting_ * lasting_ <= by_chance) return 0.0;
  return std::min((lasting_ - by_chance / lasting_) / whole_, kMost);
}

}  // namespace dottrack::estimation
