#include "app/config/target_admission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/config/complaint.h"
#include "app/core/geometry/optics.h"

namespace dottrack::config {
namespace {

constexpr double kCentre_px = 0.1;
constexpr double kAngles = 1.5;
constexpr double kLeastSigma_m = 0.5e-3;
constexpr std::size_t kMostNamed = 6;

double sigma_of(const core::Camera& camera) {
  const geometry::Optics optics(camera.model, camera.width_px, camera.height_px);
  const Eigen::Vector2d middle(0.5 * camera.width_px, 0.5 * camera.height_px);
  const double radian_px = optics.at(middle).mean_px();
  if (!(radian_px > 0.0)) return kLeastSigma_m;
  return std::max(kLeastSigma_m, kAngles * kCentre_px / radian_px * camera.distance_max_m);
}

std::string millimetres(double metres) {
  return fmt::format("{:.1f} mm", metres * 1e3);
}

class Admission {
 public:
  Admission(const core::Target& target, const TargetFile& file, const std::string& path,
            const AdmissionRules& rules)
      : target_(target),
        file_(file),
        path_(path),
        rules_(rules),
        judgement_(judge(target, rules.sigma_m)) {}

  Result<std::vector<std::string>> admit() {
    if (judgement_.ambiguous()) {
      const Error error = ambiguity();
      if (!rules_.allow_ambiguous) return tl::unexpected<Error>(error);
      warnings_.push_back(error.message);
    } else if (judgement_.most) {
      warn(partial_ambiguity());
    }
    if (!judgement_.well_conditioned()) warn(conditioning());
    if (!judgement_.complete) warn("too many of its dots look alike to try all relabellings");
    return warnings_;
  }

 private:
  void warn(const std::string& what) { warnings_.push_back(fmt::format("{}: {}", path_, what)); }

  Error ambiguity() const {
    const Relabelling& worst = *judgement_.all.relabelling;
    const auto moves = moves_to_tell_apart(target_, rules_.sigma_m);
    const std::string advice =
        moves.empty() ? "place the dots without symmetry" : describe(moves, file_.names);
    Complaint complaint(path_);
    complaint.add(file_.lines[moves.empty() ? 0 : moves.front().dot],
                  fmt::format("the target looks like itself: {}, misfits by {} RMS",
                              describe(worst, file_.names), millimetres(worst.misfit_m())),
                  fmt::format("{} or more, with dots known to {}: {}, or set allow_ambiguous",
                              millimetres(judgement_.needed_m() / std::sqrt(worst.dots)),
                              millimetres(rules_.sigma_m), advice));
    return complaint.first();
  }

  std::string partial_ambiguity() const {
    const Relabelling& most = *judgement_.most;
    return fmt::format(
        "while only {} of its {} dots are seen, some can be mistaken for others with dots known to "
        "{}: {}, misfits by {} RMS; any {} of them cannot",
        most.dots, judgement_.target_dots, millimetres(rules_.sigma_m), describe(most, file_.names),
        millimetres(most.misfit_m()), judgement_.dots_needed());
  }

  std::string conditioning() const {
    return fmt::format(
        "its dots tell the attitude to {:.1f} degrees only, with dots known to {}; {} or better "
        "takes dots farther apart, or farther from one line",
        judgement_.conditioning.attitude_deg_per_mm * rules_.sigma_m * 1e3,
        millimetres(rules_.sigma_m), kMostAttitude_deg);
  }

  const core::Target& target_;
  const TargetFile& file_;
  const std::string& path_;
  AdmissionRules rules_;
  TargetJudgement judgement_;
  std::vector<std::string> warnings_;
};

}  // namespace

double expected_sigma_m(const core::Rig& rig) {
  std::vector<double> sigmas_m;
  for (const core::Camera& camera : rig.cameras) sigmas_m.push_back(sigma_of(camera));
  if (sigmas_m.empty()) return kLeastSigma_m;
  std::sort(sigmas_m.begin(), sigmas_m.end());
  return sigmas_m[sigmas_m.size() / 2];
}

Result<std::vector<std::string>> admit_target(const core::Target& target, const TargetFile& file,
                                              const std::string& path,
                                              const AdmissionRules& rules) {
  return Admission(target, file, path, rules).admit();
}

std::string describe(const Relabelling& relabelling, std::span<const std::string> names) {
  std::string from;
  std::string to;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t label = relabelling.label[i];
    if (label == kLeftOut || label == i || ++moved > kMostNamed) continue;
    from += fmt::format(" {}", in_quotes(names[i]));
    to += fmt::format(" {}", in_quotes(names[label]));
  }
  const std::string others =
      moved > kMostNamed ? fmt::format(" and {} more", moved - kMostNamed) : "";
  return fmt::format("dots{}{} taken for{}{}, turned by {:.0f} degrees", from, others, to,
                     others.empty() ? "" : " and so on",
                     relabelling.turn_rad * 180.0 / std::numbers::pi);
}

std::string describe(std::span<const DotMove> moves, std::span<const std::string> names) {
  std::string text;
  for (const DotMove& move : moves) {
    text += fmt::format("{} dot {} by {} to {:.4f},{:.4f},{:.4f}", text.empty() ? "move" : " and",
                        in_quotes(names[move.dot]), millimetres(move.by_m), move.to_m.x(),
                        move.to_m.y(), move.to_m.z());
  }
  return text;
}

}  // namespace dottrack::config
