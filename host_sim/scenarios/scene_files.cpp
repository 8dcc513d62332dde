#include "host_sim/scenarios/scene_files.h"

#include <fmt/format.h>

#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "host_sim/renderer/cahvor_text.h"
#include "host_sim/scenarios/parallel.h"

namespace dottrack::host_sim {
namespace {

namespace fs = std::filesystem;

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return fail(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  return {};
}

Result<void> write_bytes(const fs::path& file, std::string_view head, std::string_view body = {}) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(head.data(), static_cast<std::streamsize>(head.size()));
  out.write(body.data(), static_cast<std::streamsize>(body.size()));
  out.close();
  if (!out) return fail(fmt::format("{}: cannot write the file", file.string()));
  return {};
}

Result<void> write_pgm(const fs::path& file, const GreyImage& image) {
  const std::string head = fmt::format("P5\n{} {}\n255\n", image.width_px(), image.height_px());
  const auto* bytes = reinterpret_cast<const char*>(image.pixels().data());
  return write_bytes(file, head, {bytes, image.pixels().size()});
}

// The tick in a name like 000012.pgm; nothing for any other name.
std::optional<std::uint64_t> tick_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool digits = stem.size() == 6 && stem.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || file.extension() != ".pgm") return std::nullopt;
  return std::stoull(stem);
}

Result<void> remove_ticks_from(std::uint64_t first, const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto tick = tick_of(entry.path());
    if (!tick || *tick < first) continue;
    if (!fs::remove(entry.path(), error)) break;
  }
  if (!error) return {};
  return fail(
      fmt::format("{}: cannot remove an older run's images: {}", folder.string(), error.message()));
}

std::string rig_toml(const Scene& scene) {
  const DotAppearance& dots = scene.appearance;
  std::string text = fmt::format("[rig]\nname = \"{}\"\nframe_rate_hz = {:.17g}\n", scene.name,
                                 scene.frame_rate_hz);
  if (text.find('.', text.rfind('=')) == std::string::npos) text.insert(text.size() - 1, ".0");
  for (const SceneCamera& camera : scene.cameras) {
    text += fmt::format(
        "\n[[camera]]\nname = \"{0}\"\nmodel = \"{0}.cahvor\"\ndistance_m = [{1:.3f}, {2:.3f}]\n"
        "intensity_dn = [{3}, {4}]\nmin_contrast_dn = {5}\nbackground_px = {6}\n",
        camera.name, dots.distance_min_m, dots.distance_max_m, dots.intensity_min_dn,
        dots.intensity_max_dn, dots.min_contrast_dn, dots.background_px);
  }
  text += fmt::format(
      "\n[target]\nname = \"rover\"\ndots = \"target.csv\"\nupright = true\nmax_step_m = {:.3f}\n",
      dots.max_step_m);
  return text;
}

std::string target_csv(const TargetLayout& dots) {
  std::string text = "dot,x_m,y_m,z_m,diameter_m,nx,ny,nz\n";
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const TargetDot& d = dots[i];
    text += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", i,
                        d.centre_m.x(), d.centre_m.y(), d.centre_m.z(), d.diameter_m, d.normal.x(),
                        d.normal.y(), d.normal.z());
  }
  return text;
}

std::string tum_line(double t, const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  return fmt::format("{:.9f} {:.12f} {:.12f} {:.12f} {:.15f} {:.15f} {:.15f} {:.15f}\n", t, p.x(),
                     p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

}  // namespace

Result<void> write_rig(const Scene& scene, const fs::path& folder) {
  if (auto made = make_folder(folder); !made) return made;
  for (const SceneCamera& camera : scene.cameras) {
    const std::string text = cahvor_text(camera.camera, "simulated ceiling camera " + camera.name);
    if (auto done = write_bytes(folder / (camera.name + ".cahvor"), text); !done) return done;
  }
  if (auto done = write_bytes(folder / "target.csv", target_csv(scene.target)); !done) return done;
  return write_bytes(folder / "rig.toml", rig_toml(scene));
}

Result<void> write_frames(const Scene& scene, std::uint64_t ticks, const fs::path& folder,
                          unsigned threads) {
  for (const SceneCamera& camera : scene.cameras) {
    if (auto made = make_folder(folder / camera.name); !made) return made;
    if (auto gone = remove_ticks_from(ticks, folder / camera.name); !gone) return gone;
  }
  SceneRenderer renderer(scene, threads);
  std::mutex mutex;
  std::optional<Error> failure;
  for_each_index(scene.cameras.size(), threads, [&](std::size_t i) {
    GreyImage image;
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      renderer.render_camera(i, tick, image);
      const auto written =
          write_pgm(folder / scene.cameras[i].name / fmt::format("{:06}.pgm", tick), image);
      if (written) continue;
      const std::lock_guard lock(mutex);
      failure = written.error();
      return;
    }
  });
  if (failure) return tl::unexpected<Error>(*failure);
  return {};
}

Result<void> write_truth(const Scene& scene, std::uint64_t ticks, const fs::path& file) {
  std::string text;
  Eigen::Quaterniond last = truth(scene, 0).orientation();
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    const Pose pose = truth(scene, tick);
    Eigen::Quaterniond q = pose.orientation();
    if (q.dot(last) < 0.0) q.coeffs() = -q.coeffs();
    last = q;
    text += tum_line(time_s(scene, tick), pose.position_m, q);
  }
  return write_bytes(file, text);
}

}  // namespace dottrack::host_sim
