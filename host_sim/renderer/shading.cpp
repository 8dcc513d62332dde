#include "host_sim/renderer/shading.h"

namespace dottrack::host_sim {

Finish finish_of(const Patch& patch, const Actor& actor, const Pose& pose, double footprint_m) {
  const Model& model = actor.scene->model();
  if (patch.mark >= 0) {
    const Mark& mark = model.marks[static_cast<std::size_t>(patch.mark)];
    return {mark.albedo, 0.0, 0.0, -1, pose.rotation * mark.normal};
  }
  const Material& material =
      model.parts[static_cast<std::size_t>(part_of(patch.look.thing))].material;
  const Eigen::Vector3d p_body = pose.to_body(patch.look.point);
  const Eigen::Vector3d normal_body = pose.rotation.transpose() * patch.look.normal;
  return {albedo_at(material, p_body, footprint_m), material.gloss, material.emission,
          material.lamp, pose.rotation * relief_normal(material, p_body, normal_body)};
}

void unshadowed(const Finish& finish, const Eigen::Vector3d& p, const Eigen::Vector3d& eye,
                std::span<const LampLight> lamps, std::vector<double>& radiance) {
  radiance.resize(lamps.size());
  const bool glossy = finish.gloss > 0.0;
  const Eigen::Vector3d to_eye = glossy ? (eye - p).normalized() : Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    radiance[i] = finish.albedo * from_lamp(lamps[i], p, finish.normal);
    if (glossy) radiance[i] += finish.gloss * glint(lamps[i], p, finish.normal, to_eye);
  }
}

}  // namespace dottrack::host_sim
