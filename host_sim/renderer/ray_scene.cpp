#include "host_sim/renderer/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "host_sim/renderer/exact_hit.h"
#include "host_sim/renderer/tube.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

// One thread, one instruction set that every machine has, no configuration from outside: the same
// tree and the same answers everywhere. Wider vectors would be faster by a quarter (measured).
constexpr const char* kDevice = "threads=1,isa=sse4.2,ignore_config_files=1";

constexpr double kMargin_m = 1e-3;  // of the box around a model

class SharedDevice {
 public:
  SharedDevice() : handle_(rtcNewDevice(kDevice)) {}
  ~SharedDevice() { rtcReleaseDevice(handle_); }
  SharedDevice(const SharedDevice&) = delete;
  SharedDevice& operator=(const SharedDevice&) = delete;
  RTCDevice handle() const { return handle_; }

 private:
  RTCDevice handle_;
};

RTCDevice device() {
  static const SharedDevice shared;
  return shared.handle();
}

template <class Item>
void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
          const std::vector<Item>& items) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
  std::copy(items.begin(), items.end(), static_cast<Item*>(buffer));
}

RTCGeometry geometry_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return nullptr;
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
  fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  return geometry;
}

RTCGeometry geometry_of(const Balls& balls) {
  if (balls.balls.empty()) return nullptr;
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, balls.balls);
  return geometry;
}

RTCGeometry geometry_of(const Cable& cable) {
  return cable.path.size() < 2 ? nullptr : geometry_of(tube_around(cable));
}

void throw_no_shadow(const RTCFilterFunctionNArguments* hit) {
  for (unsigned i = 0; i < hit->N; ++i) hit->valid[i] = 0;
}

struct Stretch {
  double from;
  double to;
};

// The stretch of a line inside a box, from its origin on: distances in units of its direction.
std::optional<Stretch> inside_box(const Line& line, const Vector3d& low, const Vector3d& high) {
  Stretch stretch{0.0, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - line.origin[axis]) / line.direction[axis];
    const double b = (high[axis] - line.origin[axis]) / line.direction[axis];
    stretch.from = std::max(stretch.from, std::min(a, b));  // 0/0 leaves them as they are
    stretch.to = std::min(stretch.to, std::max(a, b));
  }
  if (!(stretch.from <= stretch.to)) return std::nullopt;
  return stretch;
}

void set_ray(RTCRay& ray, const Vector3d& origin, const Vector3d& direction, double farthest) {
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = 0.0F;
  ray.tfar = static_cast<float>(farthest);
  ray.time = 0.0F;
  ray.mask = ~0U;
  ray.id = 0;
  ray.flags = 0;
}

void set_ray(RTCRay4& rays, std::size_t i, const Vector3d& origin, const Vector3d& direction,
             double farthest) {
  rays.org_x[i] = static_cast<float>(origin.x());
  rays.org_y[i] = static_cast<float>(origin.y());
  rays.org_z[i] = static_cast<float>(origin.z());
  rays.dir_x[i] = static_cast<float>(direction.x());
  rays.dir_y[i] = static_cast<float>(direction.y());
  rays.dir_z[i] = static_cast<float>(direction.z());
  rays.tfar[i] = static_cast<float>(farthest);
  rays.mask[i] = ~0U;
}

}  // namespace

struct RayScene::Device {
  RTCScene scene = rtcNewScene(device());

  Device() { rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST); }
  ~Device() { rtcReleaseScene(scene); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void add(const Part& part, unsigned id) const {
    RTCGeometry geometry = std::visit([](const auto& s) { return geometry_of(s); }, part.solid);
    if (geometry == nullptr) return;
    if (part.material.lamp >= 0) rtcSetGeometryOccludedFilterFunction(geometry, throw_no_shadow);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }
};

RayScene::RayScene(Model model)
    : model_(std::move(model)),
      device_(std::make_unique<Device>()),
      vertex_normals_(model_.parts.size()) {
  for (std::size_t i = 0; i < model_.parts.size(); ++i) {
    device_->add(model_.parts[i], static_cast<unsigned>(i));
    const auto* mesh = std::get_if<TriangleMesh>(&model_.parts[i].solid);
    if (mesh != nullptr && mesh->smooth) vertex_normals_[i] = vertex_normals(*mesh);
  }
  rtcCommitScene(device_->scene);
  RTCBounds bounds{};
  rtcGetSceneBounds(device_->scene, &bounds);
  if (!(bounds.lower_x <= bounds.upper_x)) return;
  const Vector3d margin = Vector3d::Constant(kMargin_m);
  low_ = Eigen::Vector3f(bounds.lower_x, bounds.lower_y, bounds.lower_z).cast<double>() - margin;
  high_ = Eigen::Vector3f(bounds.upper_x, bounds.upper_y, bounds.upper_z).cast<double>() + margin;
  middle_ = 0.5 * (low_ + high_);
  radius_m_ = 0.5 * (high_ - low_).norm();
}

RayScene::~RayScene() = default;

RayHit RayScene::meet(const Vector3d& origin, const Vector3d& direction, double farthest) const {
  const Line line{origin, direction};
  const auto stretch = inside_box(line, low_, high_);
  if (!stretch || stretch->from >= farthest) return {};
  RTCRayHit query;
  set_ray(query.ray, line.at(stretch->from), direction,
          std::min(farthest, stretch->to) - stretch->from);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(device_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const std::size_t part = query.hit.geomID;
  const double near = stretch->from + static_cast<double>(query.ray.tfar);
  const Solid& solid = model_.parts[part].solid;
  ExactHit hit{};
  if (const auto* mesh = std::get_if<TriangleMesh>(&solid)) {
    hit = exact_hit(*mesh, query.hit.primID, vertex_normals_[part], line, near);
  } else if (const auto* balls = std::get_if<Balls>(&solid)) {
    hit = exact_hit(*balls, query.hit.primID, line, near);
  } else {
    hit = exact_hit(std::get<Cable>(solid), query.hit.primID / kTubeTriangles, line, near);
  }
  const double length = hit.normal.norm() * (hit.normal.dot(direction) > 0.0 ? -1.0 : 1.0);
  return {hit.distance, static_cast<int>(part), hit.normal / length};
}

bool RayScene::blocked(const Vector3d& from, const Vector3d& to) const {
  const Line line{from, to - from};
  const auto stretch = inside_box(line, low_, high_);
  if (!stretch || stretch->from >= 1.0) return false;
  RTCRay ray;
  set_ray(ray, line.at(stretch->from), line.direction, std::min(1.0, stretch->to) - stretch->from);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(device_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

unsigned RayScene::blocked(const Vector3d& from, const std::array<Vector3d, 4>& to) const {
  alignas(16) RTCRay4 rays{};
  alignas(16) std::array<int, 4> valid{};
  bool any = false;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Line line{from, to[i] - from};
    const auto stretch = inside_box(line, low_, high_);
    if (!stretch || stretch->from >= 1.0) continue;
    set_ray(rays, i, line.at(stretch->from), line.direction,
            std::min(1.0, stretch->to) - stretch->from);
    valid[i] = -1;
    any = true;
  }
  if (!any) return 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded4(valid.data(), device_->scene, &context, &rays);
  unsigned hidden = 0;
  for (unsigned i = 0; i < 4; ++i) {
    if (valid[i] != 0 && rays.tfar[i] < 0.0F) hidden |= 1U << i;
  }
  return hidden;
}

}  // namespace dottrack::host_sim
