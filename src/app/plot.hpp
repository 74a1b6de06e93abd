// nsframe plot: figures of a run as SVG or PNG.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace nsframe::app {

void add_plot_command(CLI::App& program, std::function<int()>& command);

}  // namespace nsframe::app
