#pragma once
// The way of requests to a camera.

#include <libcamera/camera.h>

namespace dottrack::drivers {

// Hands a camera its requests on libcamera's own thread, which is also where a camera is found to
// be unplugged: libcamera ends the program when a request is under way to a camera at that moment.
// For one other thread, the service's.
class RequestCourier {
 public:
  // The camera outlives it.
  explicit RequestCourier(libcamera::Camera& camera);
  // Nothing is under way any more.
  ~RequestCourier();
  RequestCourier(const RequestCourier&) = delete;
  RequestCourier& operator=(const RequestCourier&) = delete;

  // Returns at once. A camera that is gone or stopped gets nothing. The request lives until a
  // round_trip().
  void hand_over(libcamera::Request& request);
  // Returns when all before it has been handed over; blocks as long as libcamera is busy.
  void round_trip();

 private:
  class Hand;

  Hand* hand_;  // libcamera's thread deletes it
};

}  // namespace dottrack::drivers
