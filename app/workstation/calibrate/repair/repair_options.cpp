#include "app/workstation/calibrate/repair/repair_options.h"

#include <string>

namespace dottrack::calibrate {

void add_repair_options(CLI::App& calibrate, RepairRequest& request) {
  auto* const run =
      calibrate.add_option("--run", request.run,
                           "With --repair: folder with the poses.csv of a run that the other "
                           "cameras tracked");
  auto* const repair = calibrate.add_option_function<std::string>(
      "--repair",
      [&calibrate, &request, run](const std::string& camera) {
        request.camera = camera;
        for (const char* name : {"--dots", "--images"}) calibrate.get_option(name)->required(false);
        calibrate.get_option("--rig")->required();
        run->required();
      },
      "Instead of all models from surveyed dots: the place of this camera, which has been moved");
  run->needs(repair);
  calibrate
      .add_option("--frames", request.frames,
                  "With --repair: the recorded frames of that run, for a camera that was moved far")
      ->needs(repair);
}

}  // namespace dottrack::calibrate
