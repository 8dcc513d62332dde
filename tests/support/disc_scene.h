#pragma once
// A small scene for tests of the loop: four cameras over a target of five bright discs on dark
// ground. It is drawn with the tracker's own camera model, so it tests the loop and its outputs,
// not the geometry.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "hal/base/image_view.h"

namespace dottrack::test {

struct GreyImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;

  ImageView view() const { return {pixels.data(), width_px, height_px, width_px}; }
  std::string pgm() const;  // as a file
};

GreyImage flat_image(int width_px, int height_px, std::uint8_t grey);
GreyImage noise_image(int width_px, int height_px, std::uint64_t seed);

class DiscScene {
 public:
  DiscScene();

  const core::Rig& rig() const { return rig_; }
  static constexpr double kFrameRate_hz = 50.0;

  // What a camera sees of the vehicle at x, y, turned by yaw.
  GreyImage image(std::size_t camera, double x_m, double y_m, double yaw_rad) const;

  // A gentle drive: where the vehicle is in a tick, and what a camera sees then.
  static core::Pose pose_at(std::uint64_t tick);
  GreyImage image_at(std::size_t camera, std::uint64_t tick) const;

  // rig.toml, cam<i>.cahv and target.csv; returns the path of rig.toml.
  std::filesystem::path write_rig(const std::filesystem::path& folder) const;
  static std::string camera_name(std::size_t camera);

 private:
  GreyImage image_of(std::size_t camera, const core::Pose& pose) const;

  core::Rig rig_;
};

// <folder>/<camera>/<tick, six digits>.pgm
std::filesystem::path frame_path(const std::filesystem::path& folder, std::size_t camera,
                                 std::uint64_t tick);

// Writes the drive's images of ticks 0 to ticks - 1 for every camera.
void write_drive(const DiscScene& scene, const std::filesystem::path& folder, std::uint64_t ticks);

// Writes bytes; missing folders are made. Throws when it cannot.
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

}  // namespace dottrack::test
