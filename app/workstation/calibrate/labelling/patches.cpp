#include "app/workstation/calibrate/labelling/patches.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace dottrack::calibrate {
namespace {

constexpr std::size_t kNearDots = 8;    // neighbours a patch is spanned by
constexpr std::size_t kNearBlobs = 14;  // of a blob
constexpr std::size_t kOfASize = 5;
constexpr std::size_t kMinOthers = 2;
constexpr double kOffPlane = 0.03;   // of the patch's size
constexpr double kMinSine = 0.35;    // of the angle at the patch's dot
constexpr double kMaxStretch = 2.6;  // of one side over the other
constexpr double kMinForeshortening = 0.25;
constexpr double kTolerance = 0.15;  // of the patch's shorter side in the image
constexpr double kFound = 0.8;       // how probably another dot is found

using Key = std::array<long, 4>;

const Eigen::Vector3d& place(const Scene& scene, int dot) {
  return scene.dots[static_cast<std::size_t>(dot)].position_m;
}

// Others of the patch, nearest first; sides e, f.
std::vector<Patch::Other> others_of(const Scene& scene, const SurveyIndex& survey,
                                    const Patch& patch) {
  const Eigen::Vector3d& p = place(scene, patch.dot);
  const Eigen::Vector3d e = place(scene, patch.first) - p;
  const Eigen::Vector3d f = place(scene, patch.second) - p;
  const Eigen::Vector3d normal = e.cross(f).normalized();
  const double size = std::max(e.norm(), f.norm());
  Eigen::Matrix<double, 3, 2> sides;
  sides << e, f;
  const Eigen::Matrix<double, 2, 3> along =
      (sides.transpose() * sides).inverse() * sides.transpose();
  std::vector<Patch::Other> others;
  for (const int dot : survey.neighbours(patch.dot)) {
    if (dot == patch.first || dot == patch.second) continue;
    const Eigen::Vector3d d = place(scene, dot) - p;
    if (std::abs(d.dot(normal)) > kOffPlane * size || d.norm() > 3.0 * size) continue;
    const Eigen::Vector2d at = along * d;
    others.push_back({dot, at.x(), at.y()});
  }
  return others;
}

long rounded(double ratio) {
  return std::lround(ratio * 25.0);
}

// Sides in the survey's typical spacing, their angle, and on which side the normal is.
std::optional<Key> key_of(const Scene& scene, const SurveyIndex& survey, const Patch& patch) {
  const SurveyedDot& dot = scene.dots[static_cast<std::size_t>(patch.dot)];
  const Eigen::Vector3d e = place(scene, patch.first) - dot.position_m;
  const Eigen::Vector3d f = place(scene, patch.second) - dot.position_m;
  const double a = e.norm();
  const double b = f.norm();
  if (!(a > 0.0 && b > 0.0) || std::max(a, b) > kMaxStretch * std::min(a, b)) return std::nullopt;
  const double sine = e.cross(f).norm() / (a * b);
  if (sine < kMinSine) return std::nullopt;
  const double unit = survey.typical_spacing_m();
  const long side = dot.normal ? (e.cross(f).dot(*dot.normal) > 0.0 ? 1 : -1) : 0;
  return Key{rounded(a / unit), rounded(b / unit), rounded(e.dot(f) / (a * b)), side};
}

class Sighter {
 public:
  Sighter(const Scene& scene, const Patch& patch) : scene_(scene), patch_(patch) {
    const SurveyedDot& dot = scene.dots[static_cast<std::size_t>(patch.dot)];
    const Eigen::Vector3d e = place(scene, patch.first) - dot.position_m;
    const Eigen::Vector3d f = place(scene, patch.second) - dot.position_m;
    const Eigen::Vector3d u = e.normalized();
    const Eigen::Vector3d w = e.cross(f).normalized().cross(u);
    Eigen::Matrix2d sides;
    sides << e.dot(u), f.dot(u), e.dot(w), f.dot(w);
    to_sides_ = sides.inverse();
    // Counterclockwise in front is clockwise in an image whose rows go down.
    if (dot.normal) turn_ = e.cross(f).dot(*dot.normal) > 0.0 ? -1 : 1;
    diameter_m_ = dot.diameter_m;
  }

  void look_around(int blob, std::vector<Sighting>& found) const {
    const std::vector<int> near = scene_.index.neighbours(blob, kNearBlobs);
    for (const int first : near) {
      for (const int second : near) {
        if (first != second) look(blob, first, second, found);
      }
    }
  }

 private:
  const Blob& blob_at(int i) const { return scene_.blobs[static_cast<std::size_t>(i)]; }

  bool plausible(int blob, const Eigen::Matrix2d& sides_px) const {
    const Eigen::Matrix2d map = sides_px * to_sides_;
    const double det = map.determinant();
    if (turn_ != 0 && (det > 0.0) != (turn_ > 0)) return false;
    const double square = map.squaredNorm();
    const double root = std::sqrt(std::max(0.0, square * square - 4.0 * det * det));
    const double longest = std::sqrt(0.5 * (square + root));
    const double shortest = std::abs(det) / longest;
    if (!(shortest > kMinForeshortening * longest)) return false;
    if (diameter_m_ <= 0.0) return true;
    const double size = blob_at(blob).semi_major_px / (0.5 * diameter_m_ * longest);
    return size > 0.5 && size < 2.5;
  }

  void look(int blob, int first, int second, std::vector<Sighting>& found) const {
    const Eigen::Vector2d& at = blob_at(blob).pixel;
    Eigen::Matrix2d sides;
    sides << blob_at(first).pixel - at, blob_at(second).pixel - at;
    if (!plausible(blob, sides)) return;
    const int layer = scene_.index.layer_of(blob);
    const double within =
        std::max(1.5, kTolerance * std::min(sides.col(0).norm(), sides.col(1).norm()));
    const double chance =
        1.0 - std::exp(-scene_.index.density(layer) * std::numbers::pi * within * within);
    const double hit = std::log(kFound / chance);
    const double miss = std::log((1.0 - kFound) / (1.0 - chance));
    double odds = 0.0;
    std::size_t seen = 0;
    std::array<int, SurveyIndex::kNeighbours> blobs{};
    blobs.fill(kNoBlob);
    for (std::size_t i = 0; i < patch_.others.size(); ++i) {
      const Patch::Other& other = patch_.others[i];
      const Eigen::Vector2d there =
          at + sides * Eigen::Vector2d(other.along_first, other.along_second);
      if (!scene_.holds(there)) continue;
      blobs[i] = scene_.index.nearest(layer, there, within);
      odds += blobs[i] < 0 ? miss : hit;
      seen += blobs[i] < 0 ? 0U : 1U;
      if (odds < 3.0 * miss) return;
    }
    if (seen < kMinOthers || odds <= 0.0) return;
    keep(blob, first, second, blobs, odds, found);
  }

  void keep(int blob, int first, int second, const std::array<int, SurveyIndex::kNeighbours>& blobs,
            double odds, std::vector<Sighting>& found) const {
    Eigen::Matrix2d sides;
    sides << blob_at(first).pixel - blob_at(blob).pixel,
        blob_at(second).pixel - blob_at(blob).pixel;
    const int size =
        static_cast<int>(std::floor(4.0 * std::log2(std::abs((sides * to_sides_).determinant()))));
    Sighting sighting{Labels(scene_.dots.size(), kNoBlob), odds, size};
    const auto label = [&](int dot, int b) {
      if (b < 0) return;
      if (std::find(sighting.labels.begin(), sighting.labels.end(), b) == sighting.labels.end()) {
        sighting.labels[static_cast<std::size_t>(dot)] = b;
      }
    };
    label(patch_.dot, blob);
    label(patch_.first, first);
    label(patch_.second, second);
    for (std::size_t i = 0; i < patch_.others.size(); ++i) label(patch_.others[i].dot, blobs[i]);
    found.push_back(std::move(sighting));
  }

  const Scene& scene_;
  const Patch& patch_;
  Eigen::Matrix2d to_sides_;
  int turn_ = 0;
  double diameter_m_ = 0.0;
};

void keep_best(std::vector<Sighting>& found, std::size_t most) {
  std::stable_sort(found.begin(), found.end(),
                   [](const Sighting& a, const Sighting& b) { return a.log_odds > b.log_odds; });
  std::map<int, std::size_t> of_size;
  std::vector<Sighting> kept;
  for (Sighting& sighting : found) {
    if (kept.size() < most && of_size[sighting.size]++ < kOfASize) {
      kept.push_back(std::move(sighting));
    }
  }
  found = std::move(kept);
}

}  // namespace

std::vector<PatchKind> patch_kinds(const Scene& scene, const SurveyIndex& survey) {
  std::map<Key, PatchKind> kinds;
  for (std::size_t i = 0; i < scene.dots.size(); ++i) {
    const std::vector<int>& near = survey.neighbours(static_cast<int>(i));
    const std::size_t k = std::min(kNearDots, near.size());
    for (std::size_t a = 0; a < k; ++a) {
      for (std::size_t b = 0; b < k; ++b) {
        if (a == b) continue;
        Patch patch{static_cast<int>(i), near[a], near[b], {}};
        const auto key = key_of(scene, survey, patch);
        if (!key || (*key)[0] > (*key)[1]) continue;  // the shorter side comes first
        patch.others = others_of(scene, survey, patch);
        if (patch.others.size() < kMinOthers) continue;
        PatchKind& kind = kinds[*key];
        kind.places.push_back({patch.dot, patch.first, patch.second});
        if (patch.others.size() > kind.example.others.size()) kind.example = patch;
      }
    }
  }
  std::vector<PatchKind> sorted;
  for (auto& [key, kind] : kinds) sorted.push_back(std::move(kind));
  std::stable_sort(sorted.begin(), sorted.end(), [](const PatchKind& a, const PatchKind& b) {
    return a.places.size() * a.example.others.size() > b.places.size() * b.example.others.size();
  });
  return sorted;
}

std::vector<Sighting> sightings(const Scene& scene, const PatchKind& kind, std::size_t most) {
  const int layer = scene.dot_layer[static_cast<std::size_t>(kind.example.dot)];
  const Sighter sighter(scene, kind.example);
  std::vector<Sighting> found;
  for (std::size_t b = 0; b < scene.blobs.size(); ++b) {
    if (scene.index.layer_of(static_cast<int>(b)) != layer) continue;
    sighter.look_around(static_cast<int>(b), found);
    if (found.size() > 100 * most) keep_best(found, most);
  }
  keep_best(found, most);
  return found;
}

}  // namespace dottrack::calibrate
