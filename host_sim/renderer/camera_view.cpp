#include "host_sim/renderer/camera_view.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host_sim/renderer/group_light.h"
#include "host_sim/renderer/live_painter.h"
#include "host_sim/renderer/shutter.h"
#include "host_sim/renderer/stage.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr double kStill_px = 0.25;  // what moves less during an exposure is not smeared
constexpr int kMostInstants = 8;

PixelBox whole(const FloatImage& image) {
  return {0, 0, image.width_px(), image.height_px()};
}

// How far the corners of the body's box move in the picture between two poses; nothing known where
// they are out of the lens's sight.
double motion_px(const SimCamera& camera, const RayScene& scene, const Pose& from, const Pose& to) {
  double most_px = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3d p((corner & 1U) != 0 ? scene.high().x() : scene.low().x(),
                     (corner & 2U) != 0 ? scene.high().y() : scene.low().y(),
                     (corner & 4U) != 0 ? scene.high().z() : scene.low().z());
    const auto a = camera.project(from.to_world(p));
    const auto b = camera.project(to.to_world(p));
    if (a && b) most_px = std::max(most_px, (*a - *b).norm());
  }
  return most_px;
}

// Into how many instants the exposure is divided.
int instants(const SimCamera& camera, std::span<const MovingBody> bodies,
             const Exposure& exposure) {
  double most_px = 0.0;
  for (const MovingBody& body : bodies) {
    const auto opens = (*body.motion)(exposure.middle_s - 0.5 * exposure.duration_s);
    const auto closes = (*body.motion)(exposure.middle_s + 0.5 * exposure.duration_s);
    if (opens && closes) {
      most_px = std::max(most_px, motion_px(camera, *body.scene, *opens, *closes));
    }
  }
  return static_cast<int>(std::clamp(std::ceil(most_px / kStill_px), 1.0, double{kMostInstants}));
}

}  // namespace

struct CameraView::Memory {
  Memory(const Hall& the_hall, const SimCamera& camera, const SensorModel& model)
      : hall(the_hall),
        stage(hall.scene, hall.lamps, camera),
        sensor(model, camera.width_px(), camera.height_px()),
        still(camera.width_px(), camera.height_px()),
        still_blurred(still),
        light(still),
        blurred(still),
        still_shares(whole(still), stage.lamps.size(), [this](int x, int y) {
          return still_look(stage.backdrop, stage.rays, x, y);
        }) {}

  void set_levels(Levels wanted, Detail detail);
  void add_up_lamps();
  void paint(std::span<const Actor> bodies, double weight);
  const FloatImage& render(const Exposure& exposure, std::span<const MovingBody> bodies,
                           const LightPlan& light, Detail detail);
  void blur_touched();

  const Hall& hall;
  Stage stage;
  Sensor sensor;
  std::optional<Levels> levels;  // of `still`
  Detail detail = Detail::full;  // with which it was added up
  std::optional<GroupLight> groups;
  FloatImage still;  // the hall without bodies
  FloatImage still_blurred;
  FloatImage light;  // with bodies; equals `still` in tiles that none has touched
  FloatImage blurred;
  ShareLattice still_shares;
  FloatImage tile_light{TileIndex::kTile_px, TileIndex::kTile_px};
  std::vector<bool> touched;  // by tile
};

void CameraView::Memory::set_levels(Levels wanted, Detail wanted_detail) {
  if (levels && *levels == wanted && detail == wanted_detail) return;
  levels = std::move(wanted);
  detail = wanted_detail;
  if (detail == Detail::quick && levels->steady()) {
    if (!groups) groups.emplace(stage.backdrop, hall.lamps, stage.lamps, sensor.model());
    groups->add_up(*levels, still, still_blurred);
  } else {
    add_up_lamps();
  }
}

// Lamp by lamp, row by row.
void CameraView::Memory::add_up_lamps() {
  const Backdrop& backdrop = stage.backdrop;
  std::vector<float> row(static_cast<std::size_t>(still.width_px()));
  for (int y = 0; y < still.height_px(); ++y) {
    double bounce = 0.0;
    for (std::size_t i = 0; i < stage.lamps.size(); ++i) {
      bounce += levels->at(y, i) * stage.lamps[i].bounce;
    }
    for (int x = 0; x < still.width_px(); ++x) {
      still.at(x, y) = static_cast<float>(bounce) * backdrop.bounced.at(x, y);
    }
    for (std::size_t i = 0; i < stage.lamps.size(); ++i) {
      const auto level = static_cast<float>(levels->at(y, i));
      if (!(level > 0.0F)) continue;
      const float* direct = &backdrop.direct[i].at(0, y);
      float* sum = &still.at(0, y);
      for (int x = 0; x < still.width_px(); ++x) sum[x] += level * direct[x];
    }
  }
  for (const Glow& glow : backdrop.glow) {
    still.at(glow.x, glow.y) += static_cast<float>(levels->at(glow.y, glow.lamp)) * glow.radiance;
  }
  blur(still, whole(still), sensor.model().blur_sigma_px, still_blurred);
}

// Adds the bodies at one instant, which makes up `weight` of the exposure.
void CameraView::Memory::paint(std::span<const Actor> bodies, double weight) {
  if (bodies.empty()) return;
  LivePainter painter(stage, *levels, still, bodies, still_shares,
                      detail == Detail::quick ? quick_care() : full_care());
  const auto share = static_cast<float>(weight);
  const auto tiles = stage.tiles.tiles();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (!painter.paint(tiles[i], tile_light)) continue;
    touched[i] = true;
    const PixelBox& box = tiles[i].box;
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        light.at(x, y) += share * (tile_light.at(x - box.x0, y - box.y0) - still.at(x, y));
      }
    }
  }
}

// Blurs anew what was touched and the tiles around, which the blur reaches into.
void CameraView::Memory::blur_touched() {
  const TileIndex& tiles = stage.tiles;
  const int columns = tiles.columns();
  const int rows = tiles.rows();
  const auto near_touched = [&](int column, int row) {
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows - 1); ++r) {
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns - 1); ++c) {
        if (touched[tiles.index(c, r)]) return true;
      }
    }
    return false;
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (!near_touched(column, row)) continue;
      PixelBox run = tiles.tiles()[tiles.index(column, row)].box;
      while (column + 1 < columns && near_touched(column + 1, row)) ++column;
      run.x1 = tiles.tiles()[tiles.index(column, row)].box.x1;
      blur(light, run, sensor.model().blur_sigma_px, blurred);
    }
  }
}

CameraView::CameraView(const Hall& hall, const SimCamera& camera, const SensorModel& sensor)
    : memory_(std::make_unique<Memory>(hall, camera, sensor)) {}

CameraView::~CameraView() = default;

const SimCamera& CameraView::camera() const {
  return memory_->stage.camera;
}

// The blurred light of all of the picture; valid until the next call.
const FloatImage& CameraView::Memory::render(const Exposure& exposure,
                                             std::span<const MovingBody> bodies,
                                             const LightPlan& plan, Detail wanted_detail) {
  const std::vector<double> times_s =
      row_times(exposure, sensor.model().line_time_s, stage.camera.height_px());
  set_levels(Levels(hall.lamps, plan, times_s), wanted_detail);
  light = still;
  touched.assign(stage.tiles.tiles().size(), false);
  const int count = instants(stage.camera, bodies, exposure);
  for (int i = 0; i < count; ++i) {
    const double offset_s = exposure.duration_s * ((i + 0.5) / count - 0.5);
    paint(bodies_at(bodies, times_s, offset_s), 1.0 / count);
  }
  if (std::find(touched.begin(), touched.end(), true) == touched.end()) return still_blurred;
  if (detail == Detail::quick) {  // the next picture is of another light: nothing to keep
    levels.reset();
    std::swap(blurred, still_blurred);
  } else {
    blurred = still_blurred;
  }
  blur_touched();
  return blurred;
}

void CameraView::render(const Exposure& exposure, std::span<const MovingBody> bodies,
                        const LightPlan& light, GreyImage& image) {
  Memory& m = *memory_;
  m.sensor.expose(m.render(exposure, bodies, light, Detail::full), exposure, image);
}

void CameraView::collect(const Exposure& exposure, std::span<const MovingBody> bodies,
                         const LightPlan& light, Detail detail, FloatImage& charge_dn) {
  Memory& m = *memory_;
  m.sensor.collect(m.render(exposure, bodies, light, detail), exposure, charge_dn);
}

void CameraView::read(const FloatImage& charge_dn, const Exposure& exposure,
                      GreyImage& image) const {
  memory_->sensor.read(charge_dn, exposure, image);
}

}  // namespace dottrack::host_sim
