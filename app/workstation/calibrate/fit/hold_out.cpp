#include "app/workstation/calibrate/fit/hold_out.h"

#include "app/core/geometry/triangulation.h"
#include "app/workstation/calibrate/fit/model_choice.h"
#include "app/workstation/calibrate/fit/parallel.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class Fold {
 public:
  Fold(const Adjustment& whole, std::size_t fold, std::size_t folds, HeldOut& out)
      : whole_(whole), part_(whole), out_(out) {
    left_out_.resize(whole.dots.size());
    for (std::size_t j = 0; j < left_out_.size(); ++j) left_out_[j] = fold_of(j, folds) == fold;
    for (View& view : part_.views) view.kept = view.kept && !left_out_[view.dot];
  }

  void judge() {
    if (!solve(part_, Loss::huber)) return;
    std::vector<geometry::CameraModel> models;
    for (const AdjustedCamera& c : part_.cameras) models.push_back(model_of(c.camera));
    std::vector<std::vector<geometry::SightLine>> lines(whole_.dots.size());
    for (std::size_t i = 0; i < whole_.views.size(); ++i) {
      const View& view = whole_.views[i];
      if (!left_out_[view.dot]) continue;
      const geometry::CameraModel& model = models[view.camera];
      Vector2d pixel;
      if (project(model, whole_.dots[view.dot].surveyed_m, pixel) == geometry::OpticsStatus::ok) {
        out_.off_px[i] = view.pixel - pixel;
      }
      geometry::SightLine line;
      if (view.kept && unproject(model, view.pixel, line.ray) == geometry::OpticsStatus::ok) {
        lines[view.dot].push_back(line);
      }
    }
    for (std::size_t j = 0; j < lines.size(); ++j) {
      geometry::Triangulation found;
      if (triangulate(lines[j], found) != geometry::TriangulationStatus::ok) continue;
      out_.off_m[j] = found.point_m - whole_.dots[j].surveyed_m;
    }
  }

 private:
  const Adjustment& whole_;
  Adjustment part_;
  HeldOut& out_;
  std::vector<bool> left_out_;
};

}  // namespace

HeldOut hold_out(const Adjustment& whole, std::size_t folds, unsigned threads) {
  HeldOut out;
  out.off_px.resize(whole.views.size());
  out.off_m.resize(whole.dots.size());
  for_each_index(folds, threads, [&](std::size_t fold) { Fold(whole, fold, folds, out).judge(); });
  return out;
}

}  // namespace dottrack::calibrate
