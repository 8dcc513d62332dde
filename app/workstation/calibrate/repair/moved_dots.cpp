#include "app/workstation/calibrate/repair/moved_dots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "app/core/acquisition/sightings.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/band.h"
#include "app/core/image/dot_fit.h"
#include "app/core/image/identify.h"
#include "app/core/tracking/expected_dot.h"
#include "drivers/recorded/pgm_reader.h"

namespace dottrack::calibrate {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using workstation::RecordedTick;

constexpr double kReach_px = 80.0;  // to each side
constexpr double kCell_px = 2.0;
constexpr double kNear_px = 5.0;   // of the common shift
constexpr double kStandOut = 1.5;  // times the votes of any cell that is not beside the best
constexpr std::size_t kFewestVotes = 20;
constexpr std::size_t kMostTicks = 400;

struct Expected {
  std::size_t dot;
  Vector2d pixel;
};

struct Picture {
  std::size_t tick;                // index
  std::vector<Expected> expected;  // under the old model
  std::vector<Vector2d> found;
};

// Where the dots lie by how far they are off, in cells.
class Votes {
 public:
  Votes() : cells_(kSide * kSide) {}

  void add(const Vector2d& off_px) {
    const auto cell = cell_of(off_px);
    if (cell) ++cells_[*cell];
  }

  // The middle of the best 2 x 2 cells; nothing where another place is about as good.
  std::optional<Vector2d> best() const {
    std::size_t most = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (sum_at(i) <= most) continue;
      most = sum_at(i);
      where = i;
    }
    if (most < kFewestVotes) return std::nullopt;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (is_beside(i, where)) continue;
      if (kStandOut * static_cast<double>(sum_at(i)) > static_cast<double>(most))
        return std::nullopt;
    }
    const auto x = static_cast<double>(where % kSide) + 1.0;
    const auto y = static_cast<double>(where / kSide) + 1.0;
    return Vector2d(kCell_px * x - kReach_px, kCell_px * y - kReach_px);
  }

 private:
  static constexpr std::size_t kSide = static_cast<std::size_t>(2.0 * kReach_px / kCell_px);

  static std::optional<std::size_t> cell_of(const Vector2d& off_px) {
    const double x = (off_px.x() + kReach_px) / kCell_px;
    const double y = (off_px.y() + kReach_px) / kCell_px;
    if (x < 0.0 || y < 0.0) return std::nullopt;
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    if (column >= kSide || row >= kSide) return std::nullopt;
    return row * kSide + column;
  }
  std::size_t sum_at(std::size_t i) const {
    if (i % kSide + 1 == kSide || i / kSide + 1 == kSide) return 0;
    return cells_[i] + cells_[i + 1] + cells_[i + kSide] + cells_[i + kSide + 1];
  }
  static bool is_beside(std::size_t a, std::size_t b) {
    const auto apart = [](std::size_t p, std::size_t q) { return p > q ? p - q : q - p; };
    constexpr std::size_t kBeside = 4;
    return apart(a % kSide, b % kSide) <= kBeside && apart(a / kSide, b / kSide) <= kBeside;
  }

  std::vector<std::uint32_t> cells_;
};

class Search {
 public:
  Search(const config::RigConfig& config, std::size_t camera)
      : config_(config),
        camera_(config.rig.cameras[camera]),
        optics_(camera_.model, camera_.width_px, camera_.height_px),
        gate_(acquisition::acquisition_gate(camera_, optics_, config.rig.target)),
        pixels_(static_cast<std::size_t>(camera_.width_px) *
                static_cast<std::size_t>(camera_.height_px)) {}

  Result<Picture> look(const RecordedTick& tick, std::size_t index, const fs::path& file) {
    Picture picture{index, {}, {}};
    for (std::size_t dot = 0; dot < config_.rig.target.dots.size(); ++dot) {
      tracking::ExpectedDot expected;
      const auto placed = tracking::placed(config_.rig.target.dots[dot], tick.pose);
      if (tracking::expect(camera_, optics_, placed, expected)) {
        picture.expected.push_back({dot, expected.pixel});
      }
    }
    if (picture.expected.empty()) return picture;
    if (auto read = drivers::read_pgm(file, camera_.width_px, camera_.height_px, pixels_); !read) {
      return tl::unexpected<Error>(read.error());
    }
    const ImageView image{pixels_.data(), camera_.width_px, camera_.height_px, camera_.width_px};
    identifier_.identify(image, image::band_of(camera_), gate_, regions_);
    for (const image::Region& region : regions_) {
      if (region.touches_border) continue;
      const image::DotFit fit = image::fit_dot(image, region, nullptr);
      if (fit.flaw == image::DotFlaw::none) picture.found.push_back(fit.centre_px);
    }
    return picture;
  }

 private:
  const config::RigConfig& config_;
  const core::Camera& camera_;
  geometry::Optics optics_;
  image::RegionGate gate_;
  image::Identifier identifier_;
  image::Regions regions_;
  std::vector<std::uint8_t> pixels_;
};

// Each dot the region that is nearest to its place, and no other dot's.
void add_views(const Picture& picture, const Vector2d& shift_px, std::size_t camera,
               RecordedTick& tick) {
  std::vector<int> taken(picture.found.size(), 0);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const Expected& expected : picture.expected) {
    double nearest = kNear_px;
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < picture.found.size(); ++i) {
      const double off = (picture.found[i] - expected.pixel - shift_px).norm();
      if (off >= nearest) continue;
      nearest = off;
      best = i;
    }
    if (!best) continue;
    ++taken[*best];
    pairs.emplace_back(expected.dot, *best);
  }
  for (const auto& [dot, found] : pairs) {
    if (taken[found] == 1) tick.views.push_back({camera, dot, picture.found[found], true});
  }
}

}  // namespace

Result<MovedDots> find_moved_dots(const config::RigConfig& config, std::size_t camera,
                                  const std::vector<RecordedTick>& ticks, const fs::path& frames) {
  const std::string& name = config.cameras[camera].name;
  Search search(config, camera);
  std::vector<Picture> pictures;
  Votes votes;
  const std::size_t stride = 1 + ticks.size() / kMostTicks;
  for (std::size_t i = 0; i < ticks.size(); i += stride) {
    const fs::path file = frames / name / fmt::format("{:06}.pgm", ticks[i].tick);
    if (!fs::exists(file)) continue;
    auto picture = search.look(ticks[i], i, file);
    if (!picture) return tl::unexpected<Error>(picture.error());
    for (const Expected& expected : picture->expected) {
      for (const Vector2d& found : picture->found) votes.add(found - expected.pixel);
    }
    if (!picture->expected.empty()) pictures.push_back(std::move(*picture));
  }
  const auto shift_px = votes.best();
  if (!shift_px) {
    return fail(
        fmt::format("{}: in {} pictures of {} no place of the dots stands out; expected a "
                    "run that drives through them, and a camera moved by less than {} "
                    "pixels",
                    (frames / name).string(), pictures.size(), name, kReach_px));
  }
  MovedDots moved;
  moved.shift_px = *shift_px;
  for (const Picture& picture : pictures) {
    RecordedTick tick = ticks[picture.tick];
    std::erase_if(tick.views, [&](const auto& view) { return view.camera == camera; });
    add_views(picture, *shift_px, camera, tick);
    moved.ticks.push_back(std::move(tick));
  }
  return moved;
}

}  // namespace dottrack::calibrate
