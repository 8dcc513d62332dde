#include "app/workstation/calibrate/labelling/guided.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace dottrack::calibrate {
namespace {

constexpr std::size_t kMostDots = 60;  // that hypotheses are made from
constexpr std::size_t kMostBlobs = 160;
constexpr std::size_t kMostAnchors = 1500;  // a dot and a blob that it may be
constexpr std::size_t kMostSettled = 24;
constexpr double kOffPart = 0.012;        // of the image's width: how far off a guess is
constexpr double kLeastApart_rad = 0.12;  // two dots of a hypothesis
constexpr double kWithin = 3.0;           // sigmas of the prior
constexpr double kSizeFactor = 1.8;       // of a blob's size from what it should be
constexpr double kMargin = 12.0;
constexpr double kPromising = 6.0;  // log odds

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Hypothesis {
  Sketch sketch;
  double odds = 0.0;
};

// From a pixel to a direction in the camera's frame.
Vector3d direction_of(const Sketch& s, const Vector2d& pixel) {
  const Vector2d distorted((pixel.x() - s.centre_px.x()) / s.focal_px,
                           (pixel.y() - s.centre_px.y()) / (s.focal_px * s.aspect));
  Vector2d u = distorted;
  for (int i = 0; i < 20; ++i) {
    const double tau = std::min(u.squaredNorm(), 4.0);
    u = distorted / std::max(0.2, 1.0 + s.k1 * tau + s.k2 * tau * tau);
  }
  return Vector3d(u.x(), u.y(), 1.0).normalized();
}

// The rotation that carries a to u, and b into the half plane of u and v.
Eigen::Matrix3d carrying(const Vector3d& a, const Vector3d& b, const Vector3d& u,
                         const Vector3d& v) {
  const auto frame = [](const Vector3d& first, const Vector3d& second) {
    Eigen::Matrix3d f;
    f.col(0) = (first + second).normalized();
    f.col(2) = first.cross(second).normalized();
    f.col(1) = f.col(2).cross(f.col(0));
    return f;
  };
  return frame(u, v) * frame(a, b).transpose();
}

class Guesser {
 public:
  Guesser(const Scene& scene, const SketchPrior& prior)
      : scene_(scene), prior_(prior), place_(prior.about.place_m()) {
    pick_dots();
    pick_blobs();
  }

  // `enough`: asked of promising ones as they come; where it says so, the search is over.
  std::vector<Hypothesis> search(const std::function<bool(const Sketch&)>& enough) {
    enough_ = enough;
    if (prior_.rotation_rad > 0.0) {
      search_about_rotation();
    } else {
      search_any_rotation();
    }
    keep_best();
    return std::move(found_);
  }

 private:
  struct Target {
    int dot;
    Vector3d direction;  // world, from the place
    double distance_m;
  };

  const Blob& blob(int i) const { return scene_.blobs[static_cast<std::size_t>(i)]; }
  int layer(int dot) const { return scene_.dot_layer[static_cast<std::size_t>(dot)]; }

  bool may_be_seen(std::size_t i, const Vector3d& towards) const {
    if (scene_.dot_layer[i] < 0) return false;
    if (scene_.dots[i].normal && towards.dot(*scene_.dots[i].normal) > 0.1) return false;
    if (prior_.rotation_rad <= 0.0) return true;
    const auto pixel = project(prior_.about, scene_.dots[i].position_m);
    if (!pixel) return false;
    const double margin = 0.2 * scene_.width_px;
    return pixel->x() > -margin && pixel->y() > -margin && pixel->x() < scene_.width_px + margin &&
           pixel->y() < scene_.height_px + margin;
  }

  // Far from each other, if there are many.
  void pick_dots() {
    std::vector<Target> all;
    for (std::size_t i = 0; i < scene_.dots.size(); ++i) {
      const Vector3d to = scene_.dots[i].position_m - place_;
      if (to.norm() > 0.0 && may_be_seen(i, to.normalized())) {
        all.push_back({static_cast<int>(i), to.normalized(), to.norm()});
      }
    }
    std::vector<double> nearest(all.size(), 1e9);
    while (targets_.size() < std::min(kMostDots, all.size())) {
      const auto furthest = std::max_element(nearest.begin(), nearest.end());
      const Target next = all[static_cast<std::size_t>(furthest - nearest.begin())];
      *furthest = -1.0;
      targets_.push_back(next);
      for (std::size_t i = 0; i < all.size(); ++i) {
        nearest[i] = std::min(nearest[i], (all[i].direction - next.direction).norm());
      }
    }
  }

  // The ones that stand out most, if there are many.
  void pick_blobs() {
    for (std::size_t i = 0; i < scene_.blobs.size(); ++i) blobs_.push_back(static_cast<int>(i));
    const auto weight = [&](int i) { return blob(i).contrast_dn * blob(i).semi_minor_px; };
    std::stable_sort(blobs_.begin(), blobs_.end(),
                     [&](int a, int b) { return weight(a) > weight(b); });
    if (blobs_.size() > kMostBlobs) blobs_.resize(kMostBlobs);
    for (const int b : blobs_) rays_.push_back(direction_of(prior_.about, blob(b).pixel));
  }

  bool size_fits(const Target& target, int b, double focal_px) const {
    const double diameter_m = scene_.dots[static_cast<std::size_t>(target.dot)].diameter_m;
    if (diameter_m <= 0.0) return true;
    const double ratio = blob(b).semi_major_px / (0.5 * diameter_m * focal_px / target.distance_m);
    return ratio < kSizeFactor && ratio > 1.0 / kSizeFactor;
  }

  double slack_rad(const Target& target) const {
    return 2.0 * prior_.place_m / target.distance_m + 0.02;
  }

  struct Anchor {
    std::size_t target;
    std::size_t blob;  // in blobs_
  };

  void search_about_rotation() {
    std::vector<Anchor> anchors;
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const Vector3d expected = prior_.about.rotation * targets_[t].direction;
      const double within = kWithin * prior_.rotation_rad + slack_rad(targets_[t]);
      for (std::size_t b = 0; b < blobs_.size(); ++b) {
        const bool same_layer = scene_.index.layer_of(blobs_[b]) == layer(targets_[t].dot);
        if (same_layer && expected.dot(rays_[b]) > std::cos(within) &&
            size_fits(targets_[t], blobs_[b], prior_.about.focal_px)) {
          anchors.push_back({t, b});
        }
      }
      if (anchors.size() > kMostAnchors) break;
    }
    for (std::size_t i = 0; i < anchors.size(); ++i) {
      for (std::size_t j = i + 1; j < anchors.size() && !over_; ++j) {
        try_rotation(anchors[i], anchors[j]);
      }
    }
  }

  void try_rotation(const Anchor& a, const Anchor& b) {
    if (a.target == b.target || a.blob == b.blob) return;
    const Target& first = targets_[a.target];
    const Target& second = targets_[b.target];
    const double apart = std::acos(std::clamp(first.direction.dot(second.direction), -1.0, 1.0));
    if (apart < kLeastApart_rad) return;
    const double seen = std::acos(std::clamp(rays_[a.blob].dot(rays_[b.blob]), -1.0, 1.0));
    const double slack =
        0.5 * (slack_rad(first) + slack_rad(second)) + 2.0 * prior_.log_focal * apart + 0.1 * apart;
    if (std::abs(apart - seen) > slack) return;
    Sketch s = prior_.about;
    s.rotation = carrying(first.direction, second.direction, rays_[a.blob], rays_[b.blob]);
    const Eigen::AngleAxisd off(Eigen::Matrix3d(s.rotation * prior_.about.rotation.transpose()));
    if (off.angle() > kWithin * prior_.rotation_rad * 1.7) return;
    consider(s);
  }

  void search_any_rotation() {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      for (std::size_t j = i + 1; j < targets_.size(); ++j) {
        const double cosine = targets_[i].direction.dot(targets_[j].direction);
        if (cosine > std::cos(kLeastApart_rad) || cosine < 0.3) continue;
        for (std::size_t a = 0; a < blobs_.size(); ++a) {
          for (std::size_t b = 0; b < blobs_.size() && !over_; ++b) {
            if (a != b) try_focal({i, a}, {j, b}, cosine);
          }
        }
      }
    }
  }

  // The focal length at which two pixels are as far apart as the dots:
  // c^2 (A^2 + f^2)(B^2 + f^2) = (A.B + f^2)^2, quadratic in f^2.
  void try_focal(const Anchor& a, const Anchor& b, double cosine) {
    const Target& first = targets_[a.target];
    const Target& second = targets_[b.target];
    const Vector2d p = blob(blobs_[a.blob]).pixel - prior_.about.centre_px;
    const Vector2d q = blob(blobs_[b.blob]).pixel - prior_.about.centre_px;
    const double c2 = cosine * cosine;
    const double pq = p.dot(q);
    const double qa = c2 - 1.0;
    const double qb = c2 * (p.squaredNorm() + q.squaredNorm()) - 2.0 * pq;
    const double qc = c2 * p.squaredNorm() * q.squaredNorm() - pq * pq;
    const double root = qb * qb - 4.0 * qa * qc;
    if (!(root >= 0.0)) return;
    for (const double sign : {-1.0, 1.0}) {
      const double f2 = (-qb + sign * std::sqrt(root)) / (2.0 * qa);
      if (!(f2 > 0.0) || !((pq + f2) * cosine > 0.0)) continue;
      const double focal = std::sqrt(f2);
      if (std::abs(std::log(focal / prior_.about.focal_px)) > prior_.log_focal) continue;
      if (!size_fits(first, blobs_[a.blob], focal) || !size_fits(second, blobs_[b.blob], focal)) {
        continue;
      }
      Sketch s = prior_.about;
      s.focal_px = focal;
      s.rotation =
          carrying(first.direction, second.direction, Vector3d(p.x(), p.y(), focal).normalized(),
                   Vector3d(q.x(), q.y(), focal).normalized());
      consider(s);
    }
  }

  // Log odds that the picked dots are about there. Hopeless ones are left early.
  void consider(Sketch& s) {
    s.translation_m = -(s.rotation * place_);
    const double sigma = kOffPart * scene_.width_px;
    double odds = 0.0;
    int inside = 0;
    for (std::size_t n = 0; n < targets_.size(); ++n) {
      const int dot = targets_[n].dot;
      const auto at = seen_at(scene_, s, dot);
      if (!at) continue;
      ++inside;
      const double density = scene_.index.density(layer(dot));
      const int b = scene_.index.nearest(layer(dot), *at, 3.0 * sigma);
      double here = 0.0;
      if (b >= 0 && size_fits(targets_[n], b, s.focal_px)) {
        here = std::exp(-0.5 * (blob(b).pixel - *at).squaredNorm() / (sigma * sigma)) /
               (2.0 * std::numbers::pi * sigma * sigma);
      }
      odds += std::log(0.7 * here / density + 0.3);
      if (inside == 10 && odds < 0.0) return;
    }
    if (odds <= 1.0) return;
    found_.push_back({s, odds});
    if (odds > kPromising && odds > asked_ + 1.0) {
      asked_ = odds;
      over_ = enough_(s);
    }
    if (found_.size() > 20000) keep_best();
  }

  void keep_best() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Hypothesis& a, const Hypothesis& b) { return a.odds > b.odds; });
    std::vector<Hypothesis> best;
    for (const Hypothesis& h : found_) {
      if (best.size() == kMostSettled) break;
      const bool known = std::any_of(best.begin(), best.end(), [&](const Hypothesis& other) {
        const double cosine =
            0.5 * ((h.sketch.rotation * other.sketch.rotation.transpose()).trace() - 1.0);
        return cosine > std::cos(0.02) &&
               std::abs(std::log(h.sketch.focal_px / other.sketch.focal_px)) < 0.04;
      });
      if (!known) best.push_back(h);
    }
    found_ = std::move(best);
  }

  const Scene& scene_;
  const SketchPrior& prior_;
  Vector3d place_;
  std::vector<Target> targets_;
  std::vector<int> blobs_;
  std::vector<Vector3d> rays_;
  std::vector<Hypothesis> found_;
  std::function<bool(const Sketch&)> enough_;
  double asked_ = 0.0;  // highest odds of a hypothesis that was asked about
  bool over_ = false;
};

bool alike(const Labels& a, const Labels& b) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) same += a[i] != kNoBlob && a[i] == b[i] ? 1U : 0U;
  return 2 * same > std::min(count(a), count(b));
}

}  // namespace

std::vector<Growth> labels_from_guess(const Scene& scene, const SurveyIndex& survey,
                                      const SketchPrior& prior) {
  const Labels none(scene.dots.size(), kNoBlob);
  const auto settled_from = [&](const Sketch& start) {
    return settle(scene, survey, start, prior, none, 2.5 * kOffPart * scene.width_px);
  };
  std::optional<Growth> sure;
  const auto enough = [&](const Sketch& start) {
    Growth growth = settled_from(start);
    if (convincing(scene, growth)) sure = std::move(growth);
    return sure.has_value();
  };
  const std::vector<Hypothesis> best = Guesser(scene, prior).search(enough);
  if (sure) return {*sure};
  std::vector<Growth> settled;
  for (const Hypothesis& h : best) settled.push_back(settled_from(h.sketch));
  std::stable_sort(settled.begin(), settled.end(),
                   [](const Growth& a, const Growth& b) { return a.log_odds > b.log_odds; });
  std::vector<Growth> kept;
  for (Growth& growth : settled) {
    if (growth.labelled == 0) continue;
    if (!kept.empty() && growth.log_odds < kept.front().log_odds - kMargin) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Growth& other) {
      return alike(growth.labels, other.labels);
    });
    if (!known) kept.push_back(std::move(growth));
  }
  return kept;
}

}  // namespace dottrack::calibrate
