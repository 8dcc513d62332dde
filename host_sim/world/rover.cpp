#include "host_sim/world/rover.h"

#include "host_sim/world/meshes.h"
#include "host_sim/world/outline.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4f;

constexpr double kWheelRadius_m = 0.125;
constexpr double kDeckThickness_m = 0.022;
const Material kGrey{0.30, Pattern::plain, 0.1};
const Material kStrut{0.24, Pattern::plain, 0.25};
const Material kWhite{0.66, Pattern::plain, 0.15};

Vector4f point(const Vector3d& p, double radius_m) {
  Vector4f result;
  result << p.cast<float>(), static_cast<float>(radius_m);
  return result;
}

Cable rod(const std::vector<Vector3d>& points, double radius_m) {
  Cable cable;
  for (const Vector3d& p : points) cable.path.push_back(point(p, radius_m));
  return cable;
}

Vector3d on_deck(const Vector2d& p, double above_m = 0.0) {
  return {p.x(), p.y(), kDeckHeight_m + above_m};
}

Outline grown(Outline outline, double factor) {
  for (Vector2d& v : outline) v *= factor;
  return outline;
}

void paint_dots(Model& model, std::size_t part, const TargetLayout& dots) {
  for (const TargetDot& dot : dots) {
    model.marks.push_back({dot.centre_m, dot.normal, 0.5 * dot.diameter_m, kDotAlbedo, part});
  }
}

std::size_t add_deck(Model& model) {
  const std::size_t deck =
      add(model, prism(deck_outline(), kDeckHeight_m - kDeckThickness_m, kDeckHeight_m),
          {0.06, Pattern::cells, 0.25, 3});
  add(model, prism(grown(deck_outline(), 1.022), kDeckHeight_m - 0.030, kDeckHeight_m - 0.006),
      {0.34, Pattern::plain, 0.1});
  return deck;
}

void add_body(Model& model) {
  const Material foil{0.42, Pattern::mottled, 0.6, 5};
  add(model, box({0.0, 0.0, 0.37}, {0.74, 0.56, 0.23}), foil);
  add(model, box({0.42, 0.0, 0.33}, {0.14, 0.36, 0.12}), kGrey);  // instruments
  add(model, cylinder({-0.36, 0.12, 0.30}, -Vector3d::UnitX(), 0.12, 0.07), kWhite);
  add(model, box({0.0, 0.2815, 0.38}, {0.20, 0.003, 0.07}), {0.8});  // labels
  add(model, box({-0.3715, -0.1, 0.38}, {0.003, 0.16, 0.09}), {0.8});
}

void add_wheel(Model& model, const Vector3d& middle, double side) {
  const Vector3d out(0.0, side, 0.0);
  const double half = 0.5 * kWheelWidth_m;
  add(model,
      revolved(middle - half * out, out,
               {{0.0, 0.02},
                {0.85 * kWheelRadius_m, 0.0},
                {kWheelRadius_m, 0.03},
                {kWheelRadius_m, kWheelWidth_m - 0.03},
                {0.85 * kWheelRadius_m, kWheelWidth_m},
                {0.0, kWheelWidth_m - 0.02}},
               24),
      {0.13, Pattern::plain, 0.1});
  add(model, disc_plate(middle + (half + 0.004) * out, out, 0.055, 0.03, 18), {0.38});
}

// Six wheels, each pair of bars as a rocker carries its front wheel and its bogie.
void add_running_gear(Model& model) {
  for (const double side : {-1.0, 1.0}) {
    const auto at = [side](double x, double y, double z) { return Vector3d(x, side * y, z); };
    for (const double x : {kHalfWheelBase_m, 0.0, -kHalfWheelBase_m}) {
      const Vector3d middle = at(x, kHalfTrack_m, kWheelRadius_m);
      add_wheel(model, middle, side);
      add(model, rod({middle, at(x, 0.46, kWheelRadius_m), at(x, 0.46, 0.27)}, 0.020), kStrut);
    }
    const Vector3d pivot = at(0.06, 0.40, 0.36);
    const Vector3d bogie = at(-0.27, 0.44, 0.31);
    add(model, rod({at(0.06, 0.26, 0.36), pivot}, 0.024), kStrut);
    add(model, rod({at(kHalfWheelBase_m, 0.46, 0.27), pivot, bogie}, 0.022), kStrut);
    add(model, rod({at(0.0, 0.46, 0.27), bogie, at(-kHalfWheelBase_m, 0.46, 0.27)}, 0.022), kStrut);
  }
}

void add_mast(Model& model) {
  const Material lens{0.04, Pattern::plain, 0.5};
  const Vector3d foot = on_deck(deck_keepouts()[0].middle);
  add(model, cylinder(foot, Vector3d::UnitZ(), 0.03, 0.055), kGrey);
  add(model, cylinder(foot, Vector3d::UnitZ(), 0.50, 0.028), kWhite);
  const Vector3d bar = foot + Vector3d(0.0, 0.0, 0.54);
  add(model, box(bar, {0.09, 0.30, 0.09}), kWhite);
  for (const double y : {-0.11, 0.11}) {
    add(model, disc_plate(bar + Vector3d(0.049, y, 0.0), Vector3d::UnitX(), 0.028, 0.01), lens);
  }
}

void add_antennas(Model& model) {
  const Vector3d high_gain = on_deck(deck_keepouts()[1].middle);
  const Vector3d low_gain = on_deck(deck_keepouts()[2].middle);
  const Vector3d tilt = Vector3d(-0.45, -0.30, 0.84).normalized();
  add(model, cylinder(high_gain, Vector3d::UnitZ(), 0.18, 0.014), kGrey);
  add(model, disc_plate(high_gain + Vector3d(0.0, 0.0, 0.19), tilt, 0.115, 0.012, 32), {0.55});
  add(model, cylinder(high_gain + Vector3d(0.0, 0.0, 0.19), tilt, 0.06, 0.02), kGrey);
  add(model, cylinder(low_gain, Vector3d::UnitZ(), 0.36, 0.020), kGrey);
  add(model, stump(low_gain + Vector3d(0.0, 0.0, 0.36), Vector3d::UnitZ(), 0.05, 0.02, 0.035),
      kWhite);
}

// Close to the edge or to what stands on the deck, where no dot is.
void add_cables(Model& model) {
  const Material black{0.05, Pattern::plain, 0.2};
  const Material pale{0.58, Pattern::plain, 0.1};
  const auto edge = [](double x, double y) { return on_deck({x, y}, 0.03); };
  add(model,
      rod({on_deck({-0.48, -0.21}, 0.02),
           edge(-0.60, -0.22),
           edge(-0.75, -0.18),
           {-0.77, -0.17, 0.46},
           {-0.40, -0.10, 0.38}},
          0.010),
      black);
  add(model,
      rod({on_deck({0.45, 0.06}, 0.02),
           edge(0.58, 0.05),
           edge(0.67, 0.04),
           {0.69, 0.03, 0.46},
           {0.44, 0.0, 0.38}},
          0.009),
      pale);
  add(model,
      rod({edge(0.30, 0.785), edge(0.08, 0.815), edge(-0.14, 0.84), {-0.18, 0.80, 0.46}}, 0.008),
      black);
  add(model,
      rod({edge(0.31, -0.78),
           on_deck({0.10, -0.81}, 0.05),
           edge(-0.13, -0.84),
           {-0.20, -0.70, 0.46}},
          0.008),
      pale);
}

void add_labels_and_bolts(Model& model) {
  const Material paper{0.82};
  const Material steel{0.62, Pattern::plain, 0.6};
  add(model, box(on_deck({-0.715, -0.28}, 0.001), {0.03, 0.10, 0.002}), paper);
  add(model, box(on_deck({0.06, 0.812}, 0.001), {0.08, 0.022, 0.002}), paper);
  add(model, box(on_deck({-0.50, -0.32}, 0.001), {0.07, 0.04, 0.002}), paper);
  const Outline& outline = deck_outline();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& from = outline[i];
    const Vector2d& to = outline[(i + 1) % outline.size()];
    const Vector2d along = (to - from).normalized();
    const Vector2d inwards(-along.y(), along.x());
    for (const double share : {0.25, 0.75}) {
      const Vector2d p = from + share * (to - from) + 0.022 * inwards;
      add(model, disc_plate(on_deck(p, 0.006), Vector3d::UnitZ(), 0.008, 0.006, 8), steel);
    }
  }
}

}  // namespace

const std::vector<Vector2d>& deck_outline() {
  static const std::vector<Vector2d> outline = {
      {0.66, 0.17},   {0.46, 0.40},   {0.32, 0.80},   {-0.16, 0.86}, {-0.33, 0.48}, {-0.74, 0.36},
      {-0.74, -0.36}, {-0.33, -0.48}, {-0.16, -0.86}, {0.32, -0.80}, {0.46, -0.40}, {0.66, -0.17}};
  return outline;
}

const std::vector<Keepout>& deck_keepouts() {
  static const std::vector<Keepout> keepouts = {{{0.44, 0.10}, 0.15},     // mast
                                                {{-0.46, -0.20}, 0.22},   // high-gain antenna
                                                {{-0.62, 0.26}, 0.10},    // low-gain antenna
                                                {{-0.715, -0.28}, 0.15},  // labels
                                                {{0.06, 0.812}, 0.14},   {{-0.50, -0.32}, 0.13}};
  return keepouts;
}

Model make_rover(const TargetLayout& dots) {
  Model rover;
  paint_dots(rover, add_deck(rover), dots);
  add_body(rover);
  add_running_gear(rover);
  add_mast(rover);
  add_antennas(rover);
  add_cables(rover);
  add_labels_and_bolts(rover);
  return rover;
}

Model make_hanging_target(const TargetLayout& dots) {
  Model target;
  const Outline plate = {{-0.84, -0.89}, {0.76, -0.89}, {0.76, 0.89}, {-0.84, 0.89}};
  const Material dark{0.07, Pattern::plain, 0.1};
  const Material steel{0.35, Pattern::plain, 0.4};
  paint_dots(target, add(target, prism(plate, kDeckHeight_m - 0.02, kDeckHeight_m), dark), dots);
  const Vector3d ring = on_deck({-0.04, 0.0}, 0.60);
  for (const Vector2d& corner : plate) {
    add(target, rod({on_deck(0.97 * corner), ring}, 0.004), steel);
  }
  const Vector3d hook = ring + Vector3d(0.0, 0.0, 1.0);
  add(target, rod({ring, hook}, 0.014), steel);
  add(target, box(hook + Vector3d(0.0, 0.0, 0.16), {0.16, 0.10, 0.32}),
      {0.5, Pattern::stripes, 0.1});
  add(target, rod({hook, hook + Vector3d(0.0, 0.0, 0.6)}, 0.010), steel);
  return target;
}

}  // namespace dottrack::host_sim
