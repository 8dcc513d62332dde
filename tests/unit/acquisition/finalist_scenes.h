#pragma once
// Random scenes of finalists, as matching would leave them: clutter of several kinds and, in half
// of the scenes, a target; and the search for the target in them, as acquisition does it.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "app/core/acquisition/evidence.h"
#include "app/core/acquisition/select.h"
#include "app/core/estimation/locate.h"
#include "app/core/geometry/orientation.h"

namespace dottrack::acquisition::test {

using Eigen::Vector3d;

// Where clutter lies.
enum class ClutterKind : std::uint8_t { everywhere, on_the_floor, in_clusters };

inline const Vector3d kRoom_m(10.0, 8.0, 2.0);

struct FinalistScene {
  core::Target target;
  std::vector<Finalist> finalists;
  std::optional<geometry::RigidMotion> truth;  // of the target; none: it is not there
  double noise_m = 0.0;
};

class SceneMaker {
 public:
  // What looks like a dot is seen by five cameras on average, or by as many more.
  explicit SceneMaker(std::uint64_t seed, int more_views = 0)
      : random_(seed), more_views_(more_views) {}

  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  double normal(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  Vector3d normals(double sigma) { return {normal(sigma), normal(sigma), normal(sigma)}; }
  Vector3d in_box(const Vector3d& half) {
    return {uniform(-half.x(), half.x()), uniform(-half.y(), half.y()),
            uniform(-half.z(), half.z())};
  }
  Vector3d in_room() { return in_box(0.5 * kRoom_m); }

  // Dots at least 12 cm apart, the first three well off a line; all of one size, or of two.
  core::Target target(std::size_t dots) {
    core::Target t;
    const bool two_sizes = chance(0.3);
    while (t.dots.size() < dots) {
      const Vector3d p = in_box({0.35, 0.3, 0.1});
      if (std::any_of(t.dots.begin(), t.dots.end(),
                      [&](const auto& d) { return (d.position_m - p).norm() < 0.12; })) {
        continue;
      }
      if (t.dots.size() == 2) {
        const Vector3d edge = t.dots[1].position_m - t.dots[0].position_m;
        if (edge.normalized().cross(p - t.dots[0].position_m).norm() < 0.12) continue;
      }
      t.dots.push_back({p, two_sizes && chance(0.5) ? 0.08 : 0.1, {}});
    }
    return t;
  }

  // Tilted by up to sixty degrees.
  geometry::RigidMotion upright_pose() {
    Eigen::Quaterniond q;
    do {
      q = Eigen::Quaterniond(normal(1.0), normal(1.0), normal(1.0), normal(1.0)).normalized();
    } while ((q * Vector3d::UnitZ()).z() < 0.5);
    return {in_room(), q};
  }

  // A dot as cameras see it: most of them by several, whether it is the target's or looks like it.
  int views_of_dot() { return 2 + more_views_ + std::binomial_distribution<int>(6, 0.5)(random_); }
  // Lines that cross by chance.
  int views_of_crossing() { return chance(0.8) ? 2 : chance(0.85) ? 3 : 4; }

  // Seen at this place with an error of its covariance: less with more views, more along one level
  // direction with two.
  Finalist seen(const Vector3d& place_m, int views, double diameter_m, double noise_m) {
    Finalist f;
    const double across_m = noise_m * std::sqrt(4.0 / views);
    const double turn = uniform(0.0, std::numbers::pi);
    const Vector3d along(std::cos(turn), std::sin(turn), 0.0);
    const double depth_m = views == 2 ? 3.0 * across_m : across_m;
    f.covariance_m2 = across_m * across_m * Eigen::Matrix3d::Identity() +
                      (depth_m * depth_m - across_m * across_m) * along * along.transpose();
    const Vector3d error = normals(across_m);
    f.position_m = place_m + error + (depth_m / across_m - 1.0) * error.dot(along) * along;
    f.diameter_m = diameter_m;
    while (f.cameras.size() < views) {
      f.cameras.insert(std::uniform_int_distribution<std::size_t>(0, 11)(random_));
    }
    f.sighting.fill(sighting_);  // nobody else's in this scene
    sighting_ = static_cast<std::uint16_t>((sighting_ + 1U) % core::kMaxRegions);
    return f;
  }

  double dot_size(double diameter_m) { return diameter_m * std::exp(normal(0.08)); }

  void add_clutter(FinalistScene& scene, ClutterKind kind, std::size_t count) {
    std::vector<Vector3d> centres(std::uniform_int_distribution<std::size_t>(3, 10)(random_));
    for (Vector3d& c : centres) c = in_room();
    const double height_m = uniform(-0.9, 0.5);
    const double dots = uniform(0.0, 0.5);
    for (std::size_t i = 0; i < count; ++i) {
      Vector3d p = in_room();
      if (kind == ClutterKind::on_the_floor && chance(0.9)) p.z() = height_m + normal(0.003);
      if (kind == ClutterKind::in_clusters && chance(0.8)) {
        p = centres[std::uniform_int_distribution<std::size_t>(0, centres.size() - 1)(random_)] +
            normals(0.3);
      }
      const double size = scene.target.dots[i % scene.target.dots.size()].diameter_m;
      const bool dot = chance(dots);
      scene.finalists.push_back(seen(p, dot ? views_of_dot() : views_of_crossing(),
                                     dot ? dot_size(size) : size * log_uniform(0.75, 1.5),
                                     scene.noise_m));
    }
  }

  // The target's dots at the pose, each hidden now and then; what was surveyed is a little wrong.
  void add_target(FinalistScene& scene, const geometry::RigidMotion& pose, double survey_m,
                  double hidden) {
    for (const core::TargetDot& dot : scene.target.dots) {
      const Vector3d place_m = pose * (dot.position_m + normals(survey_m));
      if (chance(hidden)) continue;
      scene.finalists.push_back(
          seen(place_m, views_of_dot(), dot_size(dot.diameter_m), scene.noise_m));
      scene.finalists.back().pairs = 1;
    }
  }

  FinalistScene scene(ClutterKind kind, std::size_t dots) {
    FinalistScene scene;
    scene.target = target(dots);
    scene.noise_m = log_uniform(0.001, 0.005);
    add_clutter(scene, kind, static_cast<std::size_t>(log_uniform(20.0, 400.0)));
    if (chance(0.5)) {
      scene.truth = upright_pose();
      add_target(scene, *scene.truth, log_uniform(0.0003, 0.004), 0.2);
    }
    std::shuffle(scene.finalists.begin(), scene.finalists.end(), random_);
    return scene;
  }

 private:
  std::mt19937_64 random_;
  int more_views_ = 0;
  std::uint16_t sighting_ = 0;
};

inline bool same_place(const core::Target& target, const geometry::RigidMotion& a,
                       const core::Pose& b) {
  double furthest = 0.0;
  for (const core::TargetDot& dot : target.dots) {
    furthest = std::max(
        furthest, (a * dot.position_m - (b.orientation * dot.position_m + b.position_m)).norm());
  }
  return furthest < 0.1;
}

// Looks for the target as acquisition does, among finalists of many views and of few, whole and in
// part; three dots of a larger one only where nothing certain is found, and not among those of two
// views. Of all it finds, the most probable, those at other places its rivals.
class Finder {
 public:
  std::optional<CandidateLock> find(const FinalistScene& scene, double max_rms_residual_m,
                                    bool last_resort = true) {
    limit_m_ = max_rms_residual_m;
    scene_ = &scene;
    shape_ = make_target_shape(scene.target);
    found_.clear();
    for (const int views : {4, 3, 2}) {
      for (std::size_t dots = shape_.dots; dots + 1 > std::min<std::size_t>(shape_.dots, 4);
           --dots) {
        look(views, dots);
      }
    }
    std::optional<CandidateLock> lock = best();
    if (!last_resort || shape_.dots == 3 || (lock && probability(*lock) <= kCertain)) return lock;
    for (const int views : {4, 3}) look(views, 3);
    return best();
  }

 private:
  static constexpr double kCertain = 1e-6;

  static double probability(const CandidateLock& lock) {
    return false_lock_probability(lock.log_odds, as_span(lock.rivals));
  }

  std::optional<CandidateLock> best() const {
    if (found_.empty()) return std::nullopt;
    CandidateLock lock =
        *std::max_element(found_.begin(), found_.end(),
                          [](const auto& a, const auto& b) { return a.log_odds < b.log_odds; });
    for (const CandidateLock& other : found_) {
      if (lock.rivals.size() < lock.rivals.capacity() &&
          !same_place(scene_->target, {other.pose.position_m, other.pose.orientation}, lock.pose)) {
        lock.rivals.push_back(rival_log_odds(lock, other));
      }
    }
    return lock;
  }

  // The best and the next best.
  void look(int views, std::size_t dots) {
    std::vector<DotCandidate> candidates;
    std::vector<std::uint16_t> origin;
    for (std::size_t i = 0; i < scene_->finalists.size(); ++i) {
      const Finalist& f = scene_->finalists[i];
      if (f.cameras.size() < views) continue;
      candidates.push_back({f.position_m, f.diameter_m});
      origin.push_back(static_cast<std::uint16_t>(i));
    }
    Selection selection;
    if (!select(candidates, dots, nullptr, selection)) return;
    take(selection, origin);
    const Assignment first = selection.assignment;
    if (select(candidates, dots, &first, selection)) take(selection, origin);
  }

  bool select(const std::vector<DotCandidate>& candidates, std::size_t dots,
              const Assignment* excluded, Selection& selection) {
    WorkBudget budget(20'000'000);
    selector_.start(shape_, candidates, {largest_score(shape_, limit_m_, dots), dots, excluded});
    return selector_.advance(budget, selection) == SelectStatus::found && selection.dots == dots;
  }

  void take(Selection selection, const std::vector<std::uint16_t>& origin) {
    for (std::uint16_t& a : selection.assignment) {
      a = a < origin.size() ? origin[a] : kNoCandidate;
    }
    for (std::size_t k = shape_.dots; k < core::kMaxDots; ++k)
      selection.assignment[k] = kNoCandidate;
    CandidateLock lock;
    lock.witnesses = witnesses_of(scene_->finalists, selection);
    StaticVector<estimation::LocatedDot, core::kMaxDots> dots;
    for (const Witness& w : lock.witnesses) {
      dots.push_back(estimation::triangulated_dot(w.dot, w.position_m, w.covariance_m2));
    }
    if (estimation::locate(scene_->target, as_span(dots), limit_m_, lock.pose) !=
        estimation::LocateStatus::ok) {
      return;
    }
    lock.log_odds = log_odds_of(scene_->target, as_span(lock.witnesses), lock.pose,
                                scene_->finalists, limit_m_);
    found_.push_back(lock);
  }

  Selector selector_;
  const FinalistScene* scene_ = nullptr;
  TargetShape shape_;
  double limit_m_ = 0.0;
  std::vector<CandidateLock> found_;
};

}  // namespace dottrack::acquisition::test
