#include "tests/unit/image/plain_identify.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/image/plain_background.h"

namespace dottrack::image::test {

namespace {

struct Point {
  int x;
  int y;
};

class Plain {
 public:
  Plain(const Picture& picture, const Window& window, const Band& band)
      : picture_(picture),
        band_(band),
        background_(picture, band),
        x0_(std::max(window.x_min, 0)),
        y0_(std::max(window.y_min, 0)),
        x1_(std::min(window.x_max, picture.width_px() - 1)),
        y1_(std::min(window.y_max, picture.height_px() - 1)),
        open_(static_cast<std::size_t>(picture.width_px() * picture.height_px())) {
    for (int y = y0_; y <= y1_; ++y) {
      for (int x = x0_; x <= x1_; ++x) open_[index(x, y)] = in_band(x, y);
    }
    const auto all = open_;
    for (int y = y0_; y <= y1_; ++y) {
      for (int x = x0_; x <= x1_; ++x)
        open_[index(x, y)] = all[index(x, y)] && has_neighbour(all, x, y);
    }
  }

  PlainResult identify(const RegionGate& gate) {
    PlainResult result;
    count_runs(result.counts);
    for (int y = y0_; y <= y1_; ++y) {
      for (int x = x0_; x <= x1_; ++x) {
        if (is_open(x, y)) judge(measure(flood(x, y)), gate, result);
      }
    }
    return result;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y * picture_.width_px() + x);
  }
  bool is_open(int x, int y) const {
    return x >= x0_ && x <= x1_ && y >= y0_ && y <= y1_ && open_[index(x, y)];
  }
  bool has_neighbour(const std::vector<bool>& all, int x, int y) const {
    return (x > x0_ && all[index(x - 1, y)]) || (x < x1_ && all[index(x + 1, y)]) ||
           (y > y0_ && all[index(x, y - 1)]) || (y < y1_ && all[index(x, y + 1)]);
  }

  bool in_band(int x, int y) const {
    const int value = picture_.at(x, y);
    if (value < band_.intensity_min_dn || value > band_.intensity_max_dn) return false;
    if (band_.min_contrast_dn <= 0) return true;
    return background_.excess(x, y) >= band_.min_contrast_dn;
  }

  // What the header promises of the centroid's weights.
  double weight(int x, int y) const {
    const int value = picture_.at(x, y);
    const bool bright = band_.polarity == core::Polarity::bright;
    const int beyond = bright ? value - std::max(band_.intensity_min_dn, 0) + 1
                              : std::min(band_.intensity_max_dn, 255) - value + 1;
    if (band_.min_contrast_dn <= 0) return beyond;
    return std::min(beyond, background_.excess(x, y) - band_.min_contrast_dn + 1);
  }

  void count_runs(IdentifyCounts& counts) const {
    for (int y = y0_; y <= y1_; ++y) {
      for (int x = x0_; x <= x1_; ++x) counts.runs += is_open(x, y) && !is_open(x - 1, y);
    }
  }

  std::vector<Point> flood(int x, int y) {
    std::vector<Point> region{{x, y}};
    open_[index(x, y)] = false;
    for (std::size_t i = 0; i < region.size(); ++i) {
      const Point p = region[i];
      for (const Point q : {Point{p.x + 1, p.y}, {p.x - 1, p.y}, {p.x, p.y + 1}, {p.x, p.y - 1}}) {
        if (!is_open(q.x, q.y)) continue;
        open_[index(q.x, q.y)] = false;
        region.push_back(q);
      }
    }
    return region;
  }

  Region measure(const std::vector<Point>& points) const {
    Region region;
    region.area_px = static_cast<int>(points.size());
    set_box(region, points);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
    double total = 0.0;
    for (const Point p : points) {
      const double w = weight(p.x, p.y);
      EXPECT_GE(w, 1.0);
      mean += Eigen::Vector2d(p.x, p.y) / region.area_px;
      weighted += w * Eigen::Vector2d(p.x, p.y);
      total += w;
      region.saturated_px += picture_.at(p.x, p.y) == 255;
    }
    // Rounded as identify does: half a pixel decides which one is the middle.
    const Eigen::Vector2d corner(region.x_min, region.y_min);
    region.centroid_px = corner + (weighted - total * corner) * (1.0 / total);
    set_ellipse(region, points, mean);
    region.core_contrast_dn = core_contrast(region.centroid_px, points);
    return region;
  }

  void set_box(Region& region, const std::vector<Point>& points) const {
    const auto [left, right] = std::minmax_element(points.begin(), points.end(),
                                                   [](Point a, Point b) { return a.x < b.x; });
    const auto [top, bottom] = std::minmax_element(points.begin(), points.end(),
                                                   [](Point a, Point b) { return a.y < b.y; });
    region.x_min = static_cast<std::int16_t>(left->x);
    region.x_max = static_cast<std::int16_t>(right->x);
    region.y_min = static_cast<std::int16_t>(top->y);
    region.y_max = static_cast<std::int16_t>(bottom->y);
    region.touches_border = left->x == x0_ || right->x == x1_ || top->y == y0_ || bottom->y == y1_;
  }

  static void set_ellipse(Region& region, const std::vector<Point>& points,
                          const Eigen::Vector2d& mean) {
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity() / 12.0;
    for (const Point p : points) {
      const Eigen::Vector2d d = Eigen::Vector2d(p.x, p.y) - mean;
      covariance += d * d.transpose() / region.area_px;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
    region.semi_minor_px = 2.0 * std::sqrt(solver.eigenvalues()[0]);
    region.semi_major_px = 2.0 * std::sqrt(solver.eigenvalues()[1]);
    const Eigen::Vector2d axis = solver.eigenvectors().col(1);
    region.angle_rad = std::atan2(axis.y(), axis.x());
    const double half_x = 2.0 * std::sqrt(covariance(0, 0));
    const double half_y = 2.0 * std::sqrt(covariance(1, 1));
    region.box_misfit_px = std::max({std::abs(mean.x() - half_x - (region.x_min - 0.5)),
                                     std::abs(mean.x() + half_x - (region.x_max + 0.5)),
                                     std::abs(mean.y() - half_y - (region.y_min - 0.5)),
                                     std::abs(mean.y() + half_y - (region.y_max + 0.5))});
  }

  double core_contrast(const Eigen::Vector2d& centroid, const std::vector<Point>& points) const {
    const bool bright = band_.polarity == core::Polarity::bright;
    int faintest = bright ? 255 : 0;
    for (const Point p : points) {
      const int value = picture_.at(p.x, p.y);
      faintest = bright ? std::min(faintest, value) : std::max(faintest, value);
    }
    double sum = 0.0;
    int count = 0;
    const int cx = static_cast<int>(std::floor(centroid.x() + 0.5));
    const int cy = static_cast<int>(std::floor(centroid.y() + 0.5));
    for (int y = cy - 1; y <= cy + 1; ++y) {
      for (int x = cx - 1; x <= cx + 1; ++x) {
        if (!picture_.contains(x, y)) continue;
        sum += picture_.at(x, y);
        ++count;
      }
    }
    return bright ? sum / count - faintest : faintest - sum / count;
  }

  static void judge(const Region& region, const RegionGate& gate, PlainResult& result) {
    ++result.counts.components;
    const double fill =
        region.area_px / (std::numbers::pi * region.semi_major_px * region.semi_minor_px);
    if (region.area_px < gate.min_area_px || region.semi_major_px < gate.semi_major_min_px ||
        region.semi_major_px > gate.semi_major_max_px) {
      ++result.counts.rejected_size;
    } else if (region.semi_minor_px < gate.min_axis_ratio * region.semi_major_px ||
               fill < gate.min_fill || (1.0 - fill) * region.semi_minor_px > gate.max_lack_px ||
               region.core_contrast_dn < gate.min_core_contrast_dn ||
               region.box_misfit_px >
                   gate.max_box_misfit_px + gate.max_box_misfit_part * region.semi_major_px) {
      ++result.counts.rejected_shape;
    } else if (result.regions.size() < core::kMaxRegions) {
      ++result.counts.accepted;
      result.regions.push_back(region);
    } else {
      ++result.counts.overflow_regions;
    }
  }

  const Picture& picture_;
  const Band& band_;
  PlainBackground background_;
  int x0_;
  int y0_;
  int x1_;
  int y1_;
  std::vector<bool> open_;
};

void expect_equal(const Region& expected, const Region& region) {
  constexpr double kTolerance = 1e-9;
  EXPECT_NEAR(region.centroid_px.x(), expected.centroid_px.x(), kTolerance);
  EXPECT_NEAR(region.centroid_px.y(), expected.centroid_px.y(), kTolerance);
  EXPECT_NEAR(region.semi_major_px, expected.semi_major_px, kTolerance);
  EXPECT_NEAR(region.semi_minor_px, expected.semi_minor_px, kTolerance);
  // The rounder the region, the less its angle says.
  const double roundness = expected.semi_major_px - expected.semi_minor_px;
  const double turn = std::sin(region.angle_rad - expected.angle_rad);
  EXPECT_NEAR(roundness * turn, 0.0, 2e-8 * roundness + kTolerance);
  EXPECT_NEAR(region.core_contrast_dn, expected.core_contrast_dn, kTolerance);
  EXPECT_NEAR(region.box_misfit_px, expected.box_misfit_px, kTolerance);
  EXPECT_EQ(region.area_px, expected.area_px);
  EXPECT_EQ(region.saturated_px, expected.saturated_px);
  EXPECT_EQ(region.x_min, expected.x_min);
  EXPECT_EQ(region.x_max, expected.x_max);
  EXPECT_EQ(region.y_min, expected.y_min);
  EXPECT_EQ(region.y_max, expected.y_max);
  EXPECT_EQ(region.touches_border, expected.touches_border);
}

}  // namespace

Window whole(const Picture& picture) {
  return {0, 0, picture.width_px() - 1, picture.height_px() - 1};
}

PlainResult plain_identify(const Picture& picture, const Window& window, const Band& band,
                           const RegionGate& gate) {
  return Plain(picture, window, band).identify(gate);
}

void expect_equal(const PlainResult& expected, const IdentifyCounts& counts, const Regions& regions,
                  int& comparisons) {
  EXPECT_EQ(counts.runs, expected.counts.runs);
  EXPECT_EQ(counts.components, expected.counts.components);
  EXPECT_EQ(counts.rejected_size, expected.counts.rejected_size);
  EXPECT_EQ(counts.rejected_shape, expected.counts.rejected_shape);
  EXPECT_EQ(counts.accepted, expected.counts.accepted);
  EXPECT_EQ(counts.overflow_runs, expected.counts.overflow_runs);
  EXPECT_EQ(counts.overflow_regions, expected.counts.overflow_regions);
  ASSERT_EQ(regions.size(), expected.regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) {
    expect_equal(expected.regions[i], regions[i]);
    ++comparisons;
  }
}

}  // namespace dottrack::image::test
