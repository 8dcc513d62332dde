#include "drivers/libcamera/request_courier.h"

namespace dottrack::drivers {

// libcamera posts a request to its thread behind everything posted before, and looks at what the
// kernel says only when all of that is done. What take() posts is therefore dealt with before the
// camera can be found unplugged, and before what is posted after a round trip.
class RequestCourier::Hand : public libcamera::Object {
 public:
  explicit Hand(libcamera::Camera& camera) : camera_(camera) {}

  void take(libcamera::Request* request) { camera_.queueRequest(request); }
  void arrive() {}

 private:
  libcamera::Camera& camera_;
};

RequestCourier::RequestCourier(libcamera::Camera& camera) : hand_(new Hand(camera)) {
  hand_->moveToThread(camera.thread());
}

RequestCourier::~RequestCourier() {
  round_trip();
  hand_->deleteLater();
}

void RequestCourier::hand_over(libcamera::Request& request) {
  hand_->invokeMethod(&Hand::take, libcamera::ConnectionTypeQueued, &request);
}

void RequestCourier::round_trip() {
  hand_->invokeMethod(&Hand::arrive, libcamera::ConnectionTypeBlocking);
}

}  // namespace dottrack::drivers
