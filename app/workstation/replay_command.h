#pragma once
// `dottrack replay`: the loop on recorded images.

namespace CLI {
class App;
}

namespace dottrack::workstation {

void add_replay_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
