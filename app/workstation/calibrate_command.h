#pragma once
// `dottrack calibrate`: pictures of surveyed dots to camera models.

namespace CLI {
class App;
}

namespace dottrack::workstation {

void add_calibrate_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
