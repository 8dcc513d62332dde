#pragma once
// What might be a surveyed dot in one camera's pictures.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "app/core/rig.h"
#include "hal/base/image_view.h"

namespace dottrack::calibrate {

struct Blob {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // of its rim; of its light where no fit holds
  double semi_major_px = 0.0;
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;
  double contrast_dn = 0.0;
  double sigma_px = 0.1;  // of each coordinate, from the image's noise
};

// How dots stand out. The defaults find dots from 4 to 60 px across, some 10 DN over their
// surround.
struct BlobOptions {
  core::Polarity polarity = core::Polarity::bright;
  int min_contrast_dn = 8;
  std::optional<int> background_px;  // nothing: one for small dots and one for large ones
  double min_dot_px = 3.0;           // longest extent
  double max_dot_px = 60.0;
};

// In the order of rows within tiles; one and the same for every run. The image is searched in
// tiles, since a picture of a plate may have more blobs than one search holds.
std::vector<Blob> find_blobs(const ImageView& image, const BlobOptions& options);

}  // namespace dottrack::calibrate
