#include "host_sim/scenarios/scene_files.h"

#include <fmt/format.h>

#include <cassert>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "host_sim/renderer/camera_text.h"

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

Result<void> write_bytes(const fs::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) return fail(fmt::format("{}: cannot write the file", file.string()));
  return {};
}

// What the text says of itself: the model's usual ending.
std::string_view ending(const Lens& lens) {
  switch (lens.kind) {
    case LensKind::pinhole:
      return ".cahv";
    case LensKind::radial:
      return ".cahvor";
    case LensKind::fisheye:
      return ".cahvore";
  }
  return ".txt";
}

std::string model_file(const std::string& camera, const Lens& lens) {
  return camera + std::string(ending(lens));
}

std::string can_toml(const CanModel& can) {
  const protocol::Addressing& a = can.addressing;
  std::string text =
      fmt::format("\n[can]\nbase_id = {:#x}\nextended = {}\nfd = {}\nbit_rate = {}\n", a.base_id,
                  a.extended, a.fd, std::lround(can.bit_rate));
  if (a.fd) text += fmt::format("data_bit_rate = {}\n", std::lround(can.data_bit_rate));
  return text;
}

// The cameras show a new setting in the second frame after it was made.
constexpr std::string_view kLightToml = "\n[light]\ncontrol = true\ndelay_ticks = 2\n";

std::string exposure_toml(const SceneCamera& camera) {
  return fmt::format("exposure_ms = {:.6g}\ngain = {:.6g}\n", 1e3 * camera.exposure_s, camera.gain);
}

// What all models of a calibration have in common: beside them, and called so in the rig file.
constexpr std::string_view kJointCovariance = "joint_covariance.csv";

struct ModelFiles {
  std::vector<std::string> names;  // one a camera
  bool joint_covariance = false;
};

std::string rig_toml(const Scene& scene, const ModelFiles& files) {
  const std::vector<std::string>& models = files.names;
  const DotAppearance& dots = scene.appearance;
  std::string text = fmt::format("[rig]\nname = \"{}\"\nframe_rate_hz = {:.17g}\n", scene.name,
                                 scene.frame_rate_hz);
  if (text.find('.', text.rfind('=')) == std::string::npos) text.insert(text.size() - 1, ".0");
  if (files.joint_covariance) {
    text += fmt::format("joint_covariance = \"{}\"\n", kJointCovariance);
  }
  for (std::size_t i = 0; i < models.size(); ++i) {
    const SceneCamera& camera = scene.cameras[i];
    text += fmt::format(
        "\n[[camera]]\nname = \"{0}\"\nmodel = \"{7}\"\ndistance_m = [{1:.3f}, {2:.3f}]\n"
        "intensity_dn = [{3}, {4}]\nmin_contrast_dn = {5}\n"
        "min_contrast_part = {8}\nbackground_px = {6}\n",
        camera.name, dots.distance_min_m, dots.distance_max_m, dots.intensity_min_dn,
        dots.intensity_max_dn, dots.min_contrast_dn, dots.background_px, models[i],
        dots.min_contrast_part);
    if (scene.light_control) text += exposure_toml(camera);
  }
  text += fmt::format(
      "\n[target]\nname = \"rover\"\ndots = \"target.csv\"\nupright = true\n"
      "max_step_m = {:.3f}\n",
      dots.max_step_m);
  if (scene.light_control) text += kLightToml;
  return text + can_toml(scene.can);
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

Result<void> write_target_and_rig(const Scene& scene, const fs::path& folder,
                                  const ModelFiles& models) {
  if (auto done = write_bytes(folder / "target.csv", target_csv(scene.target)); !done) return done;
  return write_bytes(folder / "rig.toml", rig_toml(scene, models));
}

Result<std::string> find_model(const fs::path& folder, const std::string& camera) {
  for (const char* kind : {".cahv", ".cahvor", ".cahvore"}) {
    if (fs::is_regular_file(folder / (camera + kind))) return camera + kind;
  }
  return fail(fmt::format("{}: no model of camera {}; expected {}.cahv, .cahvor or .cahvore",
                          folder.string(), camera, camera));
}

Result<void> copy_over(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) return fail(fmt::format("{}: cannot be written: {}", to.string(), error.message()));
  return {};
}

}  // namespace

Result<void> write_calibrated_rig(const Scene& scene, const fs::path& folder,
                                  const fs::path& models) {
  if (auto made = make_folder(folder); !made) return made;
  ModelFiles files;
  for (const SceneCamera& camera : scene.cameras) {
    const auto file = find_model(models, camera.name);
    if (!file) return tl::unexpected<Error>(file.error());
    if (auto done = copy_over(models / *file, folder / *file); !done) return done;
    files.names.push_back(*file);
  }
  files.joint_covariance = fs::is_regular_file(models / kJointCovariance);
  if (files.joint_covariance) {
    auto done = copy_over(models / kJointCovariance, folder / kJointCovariance);
    if (!done) return done;
  }
  return write_target_and_rig(scene, folder, files);
}

Result<void> write_rig(const Scene& scene, const fs::path& folder,
                       std::span<const SimCamera> models) {
  assert(models.empty() || models.size() == scene.cameras.size());
  if (auto made = make_folder(folder); !made) return made;
  std::vector<SimCamera> told(models.begin(), models.end());
  if (models.empty()) {
    for (const SceneCamera& camera : scene.cameras) told.push_back(camera.camera);
  }
  ModelFiles files;
  for (std::size_t i = 0; i < told.size(); ++i) {
    const std::string& name = scene.cameras[i].name;
    files.names.push_back(model_file(name, told[i].lens()));
    const std::string text = camera_text(told[i], "simulated ceiling camera " + name);
    if (auto done = write_bytes(folder / files.names.back(), text); !done) return done;
  }
  return write_target_and_rig(scene, folder, files);
}

Result<void> write_pgm(const fs::path& file, const ImageView& image) {
  std::string bytes = fmt::format("P5\n{} {}\n255\n", image.width_px, image.height_px);
  for (int y = 0; y < image.height_px; ++y) {
    bytes.append(reinterpret_cast<const char*>(image.row(y)),
                 static_cast<std::size_t>(image.width_px));
  }
  return write_bytes(file, bytes);
}

}  // namespace dottrack::host_sim
