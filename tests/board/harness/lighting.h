#pragma once
// The light of the virtual hall, and what of it the cameras' pictures show.

#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

#include "host_sim/usb_cameras/usb_camera_bank.h"

namespace dottrack::board {

// From any thread.
class Lighting {
 public:
  explicit Lighting(std::size_t cameras) : means_dn_(cameras, 0.0) {}

  // All lamps give this part of their light, in the pictures after the next.
  void dim_to(double part) { part_ = part; }

  // `pictures` in this light; remembers how bright they are. This must outlive the result.
  host_sim::PictureSource light(host_sim::PictureSource pictures);

  // Mean of the camera's newest picture, in DN; 0 before the first.
  double mean_dn(std::size_t camera) const;

 private:
  void note(const std::vector<host_sim::GreyImage>& images);

  std::atomic<double> part_{1.0};
  mutable std::mutex mutex_;
  std::vector<double> means_dn_;
};

}  // namespace dottrack::board
