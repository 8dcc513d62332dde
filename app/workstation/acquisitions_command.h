#pragma once
// `dottrack acquisitions`: sums up what `dottrack sim --acquisitions` has written, in one piece or
// in several.

namespace CLI {
class App;
}

namespace dottrack::workstation {

void add_acquisitions_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
