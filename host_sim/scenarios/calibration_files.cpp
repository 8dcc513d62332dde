#include "host_sim/scenarios/calibration_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "host_sim/renderer/normal_deviates.h"
#include "host_sim/scenarios/scene_files.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeastWrong_m = 0.03;
constexpr double kMostWrong_m = 0.10;

// Of what an installer knows beforehand, standard deviations.
constexpr double kPlaceSigma_m = 0.1;
constexpr double kAttitudeSigma_deg = 1.5;
constexpr double kFocalSigma = 0.02;

// What the random numbers are for.
constexpr std::uint64_t kSurvey = 0x5041;
constexpr std::uint64_t kWrong = 0x5042;
constexpr std::uint64_t kInstaller = 0x5043;

double normal(RandomStream& random) {
  return static_cast<double>(normal_deviates()[random.word() & 0xFFFFU]);
}

Vector3d normal_vector(RandomStream& random) {
  return Vector3d{normal(random), normal(random), normal(random)};
}

std::vector<std::size_t> drawn_wrong(std::size_t dots, const SurveyOptions& options) {
  RandomStream random(options.seed, kWrong);
  std::vector<std::pair<std::uint64_t, std::size_t>> lots;
  for (std::size_t i = 0; i < dots; ++i) lots.emplace_back(random.word(), i);
  std::sort(lots.begin(), lots.end());
  std::vector<std::size_t> wrong;
  for (std::size_t i = 0; i < options.wrong_dots; ++i) wrong.push_back(lots[i].second);
  std::sort(wrong.begin(), wrong.end());
  return wrong;
}

std::string name_of(std::size_t dot) {
  return fmt::format("w{:02}", dot + 1);
}

std::string dots_csv(std::span<const Mark> dots, std::span<const Vector3d> errors, double sigma_m) {
  std::string text = "dot,x_m,y_m,z_m,sigma_m,diameter_m,nx,ny,nz\n";
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const Mark& d = dots[i];
    const Vector3d p = d.centre_m + errors[i];
    text += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.6f},{:.4f},{:.6f},{:.6f},{:.6f}\n", name_of(i),
                        p.x(), p.y(), p.z(), sigma_m, 2.0 * d.radius_m, d.normal.x(), d.normal.y(),
                        d.normal.z());
  }
  return text;
}

std::vector<Vector3d> survey_errors(std::size_t dots, std::span<const std::size_t> wrong,
                                    const SurveyOptions& options) {
  std::vector<Vector3d> errors;
  for (std::size_t i = 0; i < dots; ++i) {
    RandomStream random(mix(options.seed, kSurvey), i);
    errors.push_back(options.sigma_m * normal_vector(random));
    if (std::find(wrong.begin(), wrong.end(), i) == wrong.end()) continue;
    const Vector3d way = normal_vector(random).normalized();
    errors.back() += random.uniform(kLeastWrong_m, kMostWrong_m) * way;
  }
  return errors;
}

// As measured with a tape and read off a data sheet.
SimCamera approximate(const SimCamera& truth, RandomStream random) {
  Lens lens;
  lens.kind = LensKind::pinhole;
  const double scale = 1.0 + kFocalSigma * normal(random);
  lens.focal_x_px = lens.focal_y_px = scale * truth.lens().focal_x_px;
  lens.centre_x_px = 0.5 * (truth.width_px() - 1);
  lens.centre_y_px = 0.5 * (truth.height_px() - 1);
  const Vector3d place = truth.centre_m() + kPlaceSigma_m * normal_vector(random);
  const Vector3d turned = radians(kAttitudeSigma_deg) * normal_vector(random);
  return {place, turn(turned) * truth.rotation(), lens, truth.width_px(), truth.height_px()};
}

Result<void> write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) return fail(fmt::format("{}: cannot write the file", file.string()));
  return {};
}

}  // namespace

Result<std::vector<std::string>> write_calibration(const Scene& scene, const SurveyOptions& options,
                                                   const fs::path& folder) {
  const std::span<const Mark> dots(scene.world.hall.marks.data(), scene.calibration_dots);
  if (dots.empty() || options.wrong_dots > dots.size()) {
    return fail(fmt::format("the hall has {} calibration dots; expected {} or more", dots.size(),
                            std::max<std::size_t>(options.wrong_dots, 1)));
  }
  const auto wrong = drawn_wrong(dots.size(), options);
  const auto errors = survey_errors(dots.size(), wrong, options);
  const std::vector<Vector3d> none(dots.size(), Vector3d::Zero());
  std::vector<SimCamera> guesses;
  for (const SceneCamera& camera : scene.cameras) {
    guesses.push_back(approximate(camera.camera, {mix(options.seed, kInstaller), guesses.size()}));
  }
  auto done = write_text(folder / "dots.csv", dots_csv(dots, errors, options.sigma_m));
  if (done) done = write_text(folder / "truth_dots.csv", dots_csv(dots, none, 0.0));
  if (done) done = write_rig(scene, folder / "approximate", guesses);
  if (done) done = write_rig(scene, folder / "truth");
  if (!done) return tl::unexpected<Error>(done.error());
  std::vector<std::string> names;
  for (const std::size_t dot : wrong) names.push_back(name_of(dot));
  return names;
}

}  // namespace dottrack::host_sim
