#include "app/core/acquisition/point_filter.h"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/acquisition/point_filter.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::acquisition {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;
using Vector = hn::Vec<Lanes>;
using Integers = hn::RebindToSigned<Lanes>;

HWY_INLINE Vector dot(const std::array<PointFilter::PerCamera, 3>& axis, std::size_t i, Vector x,
                      Vector y, Vector z) {
  const Lanes lanes;
  return hn::Add(
      hn::Add(hn::Mul(hn::Load(lanes, &axis[0][i]), x), hn::Mul(hn::Load(lanes, &axis[1][i]), y)),
      hn::Mul(hn::Load(lanes, &axis[2][i]), z));
}

// One camera in every lane: CAHVOR's projection, then the bit of its map.
HWY_INLINE std::uint32_t look_at(const PointFilter::Cameras& c, const std::uint32_t* maps,
                                 std::size_t i, Vector px, Vector py, Vector pz, float margin_px) {
  const Lanes lanes;
  const Integers integers;
  const auto zero = hn::Zero(lanes);
  const auto load = [&](const PointFilter::PerCamera& values)
                        HWY_ATTR { return hn::Load(lanes, &values[i]); };
  const auto dx = hn::Sub(px, load(c.centre[0]));
  const auto dy = hn::Sub(py, load(c.centre[1]));
  const auto dz = hn::Sub(pz, load(c.centre[2]));
  const auto squared = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
  const auto w = dot(c.o, i, dx, dy, dz);
  const auto w2 = hn::Mul(w, w);
  const auto tau = hn::Div(hn::Sub(squared, w2), w2);
  const auto mu =
      hn::Add(load(c.r[0]), hn::Mul(tau, hn::Add(load(c.r[1]), hn::Mul(tau, load(c.r[2])))));
  const auto grown = hn::Add(hn::Set(lanes, 1.0F), mu);
  const auto back = hn::Mul(mu, w);
  const auto along = [&](const std::array<PointFilter::PerCamera, 3>& axis,
                         const PointFilter::PerCamera& of_o) HWY_ATTR {
    return hn::Sub(hn::Mul(grown, dot(axis, i, dx, dy, dz)), hn::Mul(back, load(of_o)));
  };
  const auto range = along(c.a, c.oa);
  const auto x = hn::Div(along(c.h, c.oh), range);
  const auto y = hn::Div(along(c.v, c.ov), range);
  const auto margin = hn::Set(lanes, margin_px);
  const auto column = hn::Mul(hn::Add(x, margin), load(c.cells_per_px));
  const auto row = hn::Mul(hn::Add(y, margin), load(c.cells_per_px));
  const auto ahead = hn::And(hn::Gt(w, zero), hn::Gt(range, zero));
  const auto in_columns = hn::And(hn::Ge(column, zero), hn::Lt(column, load(c.columns)));
  const auto in_rows = hn::And(hn::Ge(row, zero), hn::Lt(row, load(c.rows)));
  const auto inside = hn::And(ahead, hn::And(in_columns, in_rows));
  const auto u = hn::ConvertTo(integers, hn::IfThenElseZero(inside, column));
  const auto v = hn::ConvertTo(integers, hn::IfThenElseZero(inside, row));
  const auto word = hn::Add(hn::Add(hn::Load(integers, &c.first_word[i]),
                                    hn::Mul(v, hn::Load(integers, &c.words_per_row[i]))),
                            hn::ShiftRight<5>(u));
  const auto bits =
      hn::BitCast(hn::RebindToUnsigned<Lanes>(),
                  hn::GatherIndex(integers, reinterpret_cast<const std::int32_t*>(maps), word));
  const auto bit =
      hn::Shr(bits, hn::BitCast(hn::RebindToUnsigned<Lanes>(), hn::And(u, hn::Set(integers, 31))));
  const auto set = hn::And(hn::Ne(hn::And(bit, hn::Set(hn::RebindToUnsigned<Lanes>(), 1U)),
                                  hn::Zero(hn::RebindToUnsigned<Lanes>())),
                           hn::RebindMask(hn::RebindToUnsigned<Lanes>(), inside));
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(hn::RebindToUnsigned<Lanes>(), set, bytes);
  return bytes[0];
}

HWY_INLINE std::uint32_t look_at_all(const PointFilter::Cameras& cameras, const std::uint32_t* maps,
                                     const Eigen::Vector3d& point, float margin_px) {
  const Lanes lanes;
  const auto x = hn::Set(lanes, static_cast<float>(point.x()));
  const auto y = hn::Set(lanes, static_cast<float>(point.y()));
  const auto z = hn::Set(lanes, static_cast<float>(point.z()));
  std::uint32_t close = 0;
  for (std::size_t i = 0; i < kMaxCameras; i += hn::Lanes(lanes)) {
    close |= look_at(cameras, maps, i, x, y, z, margin_px) << i;
  }
  return close;
}

std::uint32_t look_at_point(const PointFilter::Cameras& cameras, const std::uint32_t* maps,
                            const Eigen::Vector3d& point, float margin_px) {
  return look_at_all(cameras, maps, point, margin_px);
}

void look_at_pairs(const PointFilter::Cameras& cameras, const std::uint32_t* maps,
                   std::span<const CandidatePair> pairs, float margin_px, CameraSet* close) {
  for (const CandidatePair& pair : pairs) {
    *close++ =
        CameraSet(static_cast<std::uint16_t>(look_at_all(cameras, maps, pair.point_m, margin_px)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::acquisition
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::acquisition {
namespace {

HWY_EXPORT(look_at_point);
HWY_EXPORT(look_at_pairs);

// More than single precision is off by anywhere in an image.
constexpr double kRounding_px = 0.1;

void put(std::array<PointFilter::PerCamera, 3>& to, std::size_t camera,
         const Eigen::Vector3d& from) {
  for (int axis = 0; axis < 3; ++axis) {
    to[static_cast<std::size_t>(axis)][camera] = static_cast<float>(from[axis]);
  }
}

}  // namespace

void PointFilter::start(std::span<const CameraView> views) {
  complex_ = CameraSet{};
  cameras_ = {};
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (views[c].sightings.empty()) continue;
    if (set_camera(c, *views[c].camera)) {
      draw(c, views[c].sightings);
    } else {
      complex_.insert(c);
    }
  }
}

bool PointFilter::set_camera(std::size_t camera, const core::Camera& seen) {
  geometry::Cahvor m;
  if (!geometry::as_cahvor(seen.model, m)) return false;
  put(cameras_.centre, camera, m.c);
  put(cameras_.a, camera, m.a);
  put(cameras_.h, camera, m.h);
  put(cameras_.v, camera, m.v);
  put(cameras_.o, camera, m.o);
  put(cameras_.r, camera, m.r);
  cameras_.oa[camera] = static_cast<float>(m.o.dot(m.a));
  cameras_.oh[camera] = static_cast<float>(m.o.dot(m.h));
  cameras_.ov[camera] = static_cast<float>(m.o.dot(m.v));
  int px_per_cell = 2;
  const auto cells = [&](int size_px) {
    return static_cast<int>(size_px + 2.0 * kMargin_px) / px_per_cell + 1;
  };
  while (std::max(cells(seen.width_px), cells(seen.height_px)) > kMostCells) px_per_cell *= 2;
  cameras_.cells_per_px[camera] = 1.0F / static_cast<float>(px_per_cell);
  cameras_.columns[camera] = static_cast<float>(cells(seen.width_px));
  cameras_.rows[camera] = static_cast<float>(cells(seen.height_px));
  cameras_.words_per_row[camera] = cells(seen.width_px) / 32 + 1;
  cameras_.first_word[camera] = static_cast<std::int32_t>(camera) * kMapWords;
  return true;
}

static_assert(std::endian::native == std::endian::little);  // draw() writes words in pairs

// Sets the bits of all cells within kClose_px of a sighting.
void PointFilter::draw(std::size_t camera, const estimation::Sightings& sightings) {
  const double cells_per_px = static_cast<double>(cameras_.cells_per_px[camera]);
  const auto rows = static_cast<int>(cameras_.rows[camera]);
  const auto columns = static_cast<int>(cameras_.columns[camera]);
  const int pitch = cameras_.words_per_row[camera];
  std::uint32_t* map = maps_.data() + cameras_.first_word[camera];
  std::fill_n(map, rows * pitch + 1, 0U);
  // Sightings lie in the image, and the map reaches further beyond it than they do.
  const double right_px = columns / cells_per_px - 2.0 * kMargin_px;
  const double bottom_px = rows / cells_per_px - 2.0 * kMargin_px;
  constexpr double kReach_px = kClose_px + kRounding_px;
  static_assert(kReach_px < kMargin_px);
  for (const estimation::Sighting& sighting : sightings) {
    const double x = kMargin_px + std::clamp(sighting.pixel.x(), 0.0, right_px);
    const double y = kMargin_px + std::clamp(sighting.pixel.y(), 0.0, bottom_px);
    const auto from = static_cast<unsigned>((x - kReach_px) * cells_per_px);
    const auto to = static_cast<unsigned>((x + kReach_px) * cells_per_px);
    const auto first = static_cast<int>((y - kReach_px) * cells_per_px);
    const auto last = static_cast<int>((y + kReach_px) * cells_per_px);
    const std::uint64_t bits = ((std::uint64_t{2} << (to - from)) - 1U) << (from % 32);
    std::uint32_t* word = map + std::ptrdiff_t{first} * pitch + from / 32;
    for (int row = first; row <= last; ++row, word += pitch) {
      std::uint64_t two;
      std::memcpy(&two, word, sizeof(two));
      two |= bits;
      std::memcpy(word, &two, sizeof(two));
    }
  }
}

CameraSet PointFilter::look(const Eigen::Vector3d& point_m) const {
  const std::uint32_t close = HWY_DYNAMIC_DISPATCH(look_at_point)(cameras_, maps_.data(), point_m,
                                                                  static_cast<float>(kMargin_px));
  return CameraSet(static_cast<std::uint16_t>(close | complex_.bits()));
}

void PointFilter::look(std::span<const CandidatePair> pairs, std::span<CameraSet> close) const {
  HWY_DYNAMIC_DISPATCH(look_at_pairs)
  (cameras_, maps_.data(), pairs, static_cast<float>(kMargin_px), close.data());
  if (complex_.empty()) return;
  for (CameraSet& cameras : close.first(pairs.size())) {
    cameras = CameraSet(static_cast<std::uint16_t>(cameras.bits() | complex_.bits()));
  }
}

}  // namespace dottrack::acquisition
#endif
