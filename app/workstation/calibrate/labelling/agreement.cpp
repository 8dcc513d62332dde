#include "app/workstation/calibrate/labelling/agreement.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/config/complaint.h"

namespace dottrack::calibrate {
namespace {

constexpr double kMeet_px = 3.0;
constexpr double kSureAgreement = 4.0;  // standard deviations more than the next best
constexpr double kSureUpright = 0.5;    // more than the next best

struct OtherMarks {
  std::vector<int> blobs;
  BlobIndex index;
};

OtherMarks other_marks(const Scene& scene, const Growth& growth) {
  std::vector<bool> taken(scene.blobs.size(), false);
  for (const int blob : growth.labels) {
    if (blob != kNoBlob) taken[static_cast<std::size_t>(blob)] = true;
  }
  OtherMarks marks;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<int> layers;
  for (std::size_t i = 0; i < scene.blobs.size(); ++i) {
    if (taken[i] || scene.index.layer_of(static_cast<int>(i)) != 0) continue;
    marks.blobs.push_back(static_cast<int>(i));
    pixels.push_back(scene.blobs[i].pixel);
    layers.push_back(0);
  }
  marks.index = BlobIndex(pixels, layers, scene.width_px, scene.height_px);
  return marks;
}

// Labelled dots by their distance to a pixel: the three nearest that are no line.
std::optional<Eigen::Vector3d> on_surface(const Scene& scene, const Growth& growth,
                                          const Eigen::Vector2d& pixel) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < growth.labels.size(); ++i) {
    if (growth.labels[i] == kNoBlob || scene.dot_layer[i] != 0) continue;
    const auto& at = scene.blobs[static_cast<std::size_t>(growth.labels[i])].pixel;
    near.emplace_back((at - pixel).squaredNorm(), i);
  }
  const std::size_t k = std::min<std::size_t>(6, near.size());
  if (k < 3) return std::nullopt;
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(k), near.end());
  const auto pixel_of = [&](std::size_t n) -> const Eigen::Vector2d& {
    return scene.blobs[static_cast<std::size_t>(growth.labels[near[n].second])].pixel;
  };
  const Eigen::Vector2d e = pixel_of(1) - pixel_of(0);
  for (std::size_t n = 2; n < k; ++n) {
    const Eigen::Vector2d f = pixel_of(n) - pixel_of(0);
    const double cross = e.x() * f.y() - e.y() * f.x();
    if (std::abs(cross) < 0.4 * e.norm() * f.norm()) continue;
    const Eigen::Vector2d d = pixel - pixel_of(0);
    const double along_e = (d.x() * f.y() - d.y() * f.x()) / cross;
    const double along_f = (e.x() * d.y() - e.y() * d.x()) / cross;
    if (std::abs(along_e) > 2.0 || std::abs(along_f) > 2.0) return std::nullopt;
    const auto place = [&](std::size_t m) -> const Eigen::Vector3d& {
      return scene.dots[near[m].second].position_m;
    };
    return place(0) + along_e * (place(1) - place(0)) + along_f * (place(n) - place(0));
  }
  return std::nullopt;
}

// Whichever of the alternatives has the most, if it has so much more than the next.
struct Best {
  std::size_t which = 0;
  double lead = 0.0;
};

Best best_of(const std::vector<double>& scores) {
  Best best;
  double next = -1e300;
  for (std::size_t i = 1; i < scores.size(); ++i) {
    if (scores[i] > scores[best.which]) {
      next = std::max(next, scores[best.which]);
      best.which = i;
    } else {
      next = std::max(next, scores[i]);
    }
  }
  best.lead = scores[best.which] - next;
  return best;
}

void leave_one(LabelledCamera& camera, std::size_t which) {
  std::swap(camera.labellings.front(), camera.labellings[which]);
  camera.labellings.resize(1);
}

// By how much the second labelling's world is turned against the first's.
double turned_rad(const Growth& a, const Growth& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.sketch.rotation.transpose() * b.sketch.rotation))
      .angle();
}

class Decision {
 public:
  Decision(const std::vector<CameraInput>& inputs, std::vector<LabelledCamera>& cameras)
      : inputs_(inputs), cameras_(cameras) {}

  void by_what_is_known() {
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      const bool known = inputs_[c].approximate || inputs_[c].near_m;
      if (!known || !open(c)) continue;
      std::vector<double> scores;
      for (const Growth& g : cameras_[c].labellings) scores.push_back(-strangeness(inputs_[c], g));
      const Best best = best_of(scores);
      if (best.lead > 0.5 * -scores[best.which]) leave_one(cameras_[c], best.which);
    }
  }

  // The first one fixes the world; it stands upright, if that is all that is known.
  Result<void> by_uprightness(std::size_t c, const char* why) {
    if (auto shifted = check_turned(c); !shifted) return shifted;
    std::vector<double> scores;
    for (const Growth& g : cameras_[c].labellings) scores.push_back(uprightness(g));
    const Best best = best_of(scores);
    if (best.lead < kSureUpright) return fail(open_message(c));
    const double degrees = 180.0 / std::numbers::pi *
                           turned_rad(cameras_[c].labellings[best.which],
                                      cameras_[c].labellings[best.which == 0 ? 1 : 0]);
    remarks_.push_back(
        fmt::format("camera {}: the dots look the same turned by {:.0f} degrees; taken as the "
                    "camera stands upright{}",
                    config::in_quotes(inputs_[c].pictures.name), degrees, why));
    leave_one(cameras_[c], best.which);
    return {};
  }

  // True where the other marks tell.
  bool by_other_marks(std::size_t c) {
    std::vector<double> scores;
    for (const Growth& g : cameras_[c].labellings) {
      double sum = 0.0;
      for (std::size_t d = 0; d < cameras_.size(); ++d) {
        if (d == c || open(d)) continue;
        sum += agreement(cameras_[c].scene, g, cameras_[d].scene, cameras_[d].labellings.front());
        sum += agreement(cameras_[d].scene, cameras_[d].labellings.front(), cameras_[c].scene, g);
      }
      scores.push_back(sum);
    }
    const Best best = best_of(scores);
    if (best.lead < kSureAgreement) return false;
    remarks_.push_back(fmt::format(
        "camera {}: which way round it sees the dots was told by other marks that cameras share",
        config::in_quotes(inputs_[c].pictures.name)));
    leave_one(cameras_[c], best.which);
    return true;
  }

  Result<std::vector<std::string>> run() {
    by_what_is_known();
    const bool all_open = none_decided();
    if (all_open && !cameras_.empty()) {
      if (auto done = by_uprightness(most_upright(), ""); !done) {
        return tl::unexpected<Error>(done.error());
      }
    }
    for (bool told = true; told;) {
      told = false;
      for (std::size_t c = 0; c < cameras_.size(); ++c)
        told = (open(c) && by_other_marks(c)) || told;
    }
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      if (!open(c)) continue;
      const auto done = by_uprightness(c, "; nothing else tells: check it, or give --seeds");
      if (!done) return tl::unexpected<Error>(done.error());
    }
    return std::move(remarks_);
  }

 private:
  bool open(std::size_t c) const { return cameras_[c].labellings.size() > 1; }

  bool none_decided() const {
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      if (!open(c)) return false;
    }
    return true;
  }

  std::size_t most_upright() const {
    std::size_t most = 0;
    double lead = -1.0;
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      std::vector<double> scores;
      for (const Growth& g : cameras_[c].labellings) scores.push_back(uprightness(g));
      const Best best = best_of(scores);
      if (best.lead > lead + 0.05) {
        most = c;
        lead = best.lead;
      }
    }
    return most;
  }

  // A grid that is seen one pitch further is no matter of which way is up.
  Result<void> check_turned(std::size_t c) const {
    const auto& all = cameras_[c].labellings;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = i + 1; j < all.size(); ++j) {
        if (turned_rad(all[i], all[j]) > 0.3) continue;
        return fail(open_message(c));
      }
    }
    return {};
  }

  std::string open_message(std::size_t c) const {
    const auto& all = cameras_[c].labellings;
    std::string example;
    for (std::size_t i = 0; i < all[0].labels.size() && example.empty(); ++i) {
      if (all[0].labels[i] == kNoBlob) continue;
      for (std::size_t j = 0; j < all[1].labels.size(); ++j) {
        if (j == i || all[1].labels[j] != all[0].labels[i]) continue;
        const auto& dots = cameras_[c].scene.dots;
        example = fmt::format(", dot {} as well as dot {}", config::in_quotes(dots[i].name),
                              config::in_quotes(dots[j].name));
        break;
      }
    }
    return fmt::format(
        "camera {}: its dots fit the survey in {} ways{}; show it dots that do not repeat, up to "
        "the edge of their pattern, or give --seeds or --models",
        config::in_quotes(inputs_[c].pictures.name), all.size(), example);
  }

  const std::vector<CameraInput>& inputs_;
  std::vector<LabelledCamera>& cameras_;
  std::vector<std::string> remarks_;
};

}  // namespace

double agreement(const Scene& a, const Growth& in_a, const Scene& b, const Growth& in_b) {
  const OtherMarks from = other_marks(a, in_a);
  const OtherMarks to = other_marks(b, in_b);
  const double chance =
      1.0 - std::exp(-to.index.density(0) * std::numbers::pi * kMeet_px * kMeet_px);
  double tried = 0.0;
  double met = 0.0;
  for (const int blob : from.blobs) {
    const auto place = on_surface(a, in_a, a.blobs[static_cast<std::size_t>(blob)].pixel);
    if (!place) continue;
    const auto pixel = project(in_b.sketch, *place);
    if (!pixel || !b.holds(*pixel)) continue;
    tried += 1.0;
    met += to.index.nearest(0, *pixel, kMeet_px) >= 0 ? 1.0 : 0.0;
  }
  const double spread = std::sqrt(std::max(tried * chance * (1.0 - chance), 1.0));
  return (met - tried * chance) / spread;
}

double uprightness(const Growth& labelling) {
  const Eigen::Matrix3d& r = labelling.sketch.rotation;
  const bool along_z = std::abs(r(2, 2)) > std::sqrt(0.5);
  const double up = along_z ? -r(1, 1) : -r(1, 2);
  return up + (along_z ? -0.5 * r(2, 2) : 0.0);
}

double strangeness(const CameraInput& input, const Growth& labelling) {
  const Sketch& s = labelling.sketch;
  Eigen::Vector3d place = s.place_m();
  double strange = 0.0;
  if (input.approximate) {
    const Sketch guess = as_sketch(*input.approximate);
    strange += Eigen::AngleAxisd(Eigen::Matrix3d(s.rotation * guess.rotation.transpose())).angle();
    place -= guess.place_m();
  } else if (input.near_m) {
    place -= *input.near_m;
  }
  return strange + place.norm() / std::max(s.translation_m.norm(), 1e-6);
}

Result<std::vector<std::string>> decide(const std::vector<CameraInput>& inputs,
                                        std::vector<LabelledCamera>& cameras) {
  return Decision(inputs, cameras).run();
}

}  // namespace dottrack::calibrate
