// nsframe motion: its subcommands.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace nsframe::app {

void add_motion_command(CLI::App& program, std::function<int()>& command);
void add_spectrum_command(CLI::App& program, std::function<int()>& command);

}  // namespace nsframe::app
