#include <libcamera/property_ids.h>

#include "drivers/libcamera/libcamera_grabber.h"
#include "drivers/libcamera/picture_format.h"
#include "drivers/libcamera/shared_manager.h"

namespace dottrack::drivers {

Result<std::vector<CameraListing>> list_cameras() {
  const auto manager = SharedManager::use();
  if (!manager) return tl::unexpected(manager.error());
  std::vector<CameraListing> listings;
  for (const auto& camera : (*manager)->cameras().cameras()) {
    const auto model = camera->properties().get(libcamera::properties::Model);
    listings.push_back({.id = camera->id(),
                        .model = model ? std::string(*model) : std::string(),
                        .sizes = offered_sizes(*camera)});
  }
  return listings;
}

}  // namespace dottrack::drivers
