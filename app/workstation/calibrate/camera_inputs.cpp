#include "app/workstation/calibrate/camera_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "app/config/camera_file.h"
#include "app/config/complaint.h"
#include "app/config/rig_file.h"

namespace dottrack::calibrate {
namespace {

namespace fs = std::filesystem;

class Reader {
 public:
  Reader(const InputFiles& files, std::span<const SurveyedDot> dots) : files_(files), dots_(dots) {}

  Result<std::vector<CameraInput>> read() {
    auto pictures = list_pictures(files_.images);
    if (!pictures) return tl::unexpected<Error>(pictures.error());
    for (CameraPictures& camera : *pictures) inputs_.push_back({std::move(camera), {}, {}, {}});
    Result<void> done;
    if (done && !files_.rig.empty()) done = read_rig();
    if (done && !files_.models.empty()) done = read_models();
    if (done && !files_.places.empty()) done = read_places_of();
    if (done && !files_.seeds.empty()) done = read_seeds_of();
    if (!done) return tl::unexpected<Error>(done.error());
    return std::move(inputs_);
  }

 private:
  CameraInput* find(const std::string& name) {
    const auto found = std::find_if(inputs_.begin(), inputs_.end(), [&](const CameraInput& input) {
      return input.pictures.name == name;
    });
    return found == inputs_.end() ? nullptr : &*found;
  }

  tl::unexpected<Error> no_pictures(const fs::path& file, const std::string& name) const {
    return fail(
        fmt::format("{}: camera {} has no pictures in {}; expected {}.pgm or a folder of "
                    "that name",
                    file.string(), config::in_quotes(name), files_.images.string(), name));
  }

  // A camera of the rig without pictures is not calibrated; there must be one with.
  Result<void> read_rig() {
    const auto rig = config::load_rig(files_.rig, config::Targets::taken_as_they_are);
    if (!rig) return tl::unexpected<Error>(rig.error());
    bool any = false;
    for (std::size_t i = 0; i < rig->cameras.size(); ++i) {
      if (CameraInput* input = find(rig->cameras[i].name)) {
        input->approximate = rig->rig.cameras[i].model;
        any = true;
      }
    }
    if (!any) return no_pictures(files_.rig, rig->cameras.front().name);
    return {};
  }

  Result<void> read_models() {
    constexpr std::array kKinds{".cahvor", ".cahv", ".cahvore"};
    for (CameraInput& input : inputs_) {
      fs::path file;
      std::error_code ignored;
      for (const char* kind : kKinds) {
        const fs::path tried = files_.models / (input.pictures.name + kind);
        if (file.empty() && fs::is_regular_file(tried, ignored)) file = tried;
      }
      if (file.empty()) {
        return fail(fmt::format("{}: no model of camera {}; expected {}.cahv, .cahvor or .cahvore",
                                files_.models.string(), config::in_quotes(input.pictures.name),
                                input.pictures.name));
      }
      auto model = config::read_camera_file(file);
      if (!model) return tl::unexpected<Error>(model.error());
      input.approximate = model->model;
    }
    return {};
  }

  Result<void> read_places_of() {
    const auto places = read_places(files_.places);
    if (!places) return tl::unexpected<Error>(places.error());
    for (const auto& [name, place] : *places) {
      CameraInput* input = find(name);
      if (input == nullptr) return no_pictures(files_.places, name);
      input->near_m = place;
    }
    return {};
  }

  Result<void> read_seeds_of() {
    const auto seeds = read_seeds(files_.seeds, dots_);
    if (!seeds) return tl::unexpected<Error>(seeds.error());
    for (const auto& [name, of_camera] : *seeds) {
      CameraInput* input = find(name);
      if (input == nullptr) return no_pictures(files_.seeds, name);
      input->seeds = of_camera;
    }
    return {};
  }

  const InputFiles& files_;
  std::span<const SurveyedDot> dots_;
  std::vector<CameraInput> inputs_;
};

}  // namespace

Result<std::vector<CameraInput>> read_inputs(const InputFiles& files,
                                             std::span<const SurveyedDot> dots) {
  return Reader(files, dots).read();
}

}  // namespace dottrack::calibrate
