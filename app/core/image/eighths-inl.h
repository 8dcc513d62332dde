// How backgrounds are interpolated between the middles of tiles: by averages of two.
// Included once a target (foreach_target.h).

#if defined(DOTTRACK_IMAGE_EIGHTHS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DOTTRACK_IMAGE_EIGHTHS_INL_H_
#undef DOTTRACK_IMAGE_EIGHTHS_INL_H_
#else
#define DOTTRACK_IMAGE_EIGHTHS_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One, three, five and seven eighths of the way from a to b, each average rounded up.
template <class D, class V = hn::Vec<D>>
struct Eighths {
  HWY_INLINE Eighths(V a, V b) {
    const V middle = hn::AverageRound(a, b);
    const V quarter = hn::AverageRound(a, middle);
    const V three_quarters = hn::AverageRound(middle, b);
    one = hn::AverageRound(a, quarter);
    three = hn::AverageRound(quarter, middle);
    five = hn::AverageRound(middle, three_quarters);
    seven = hn::AverageRound(three_quarters, b);
  }

  V one, three, five, seven;
};

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#endif
