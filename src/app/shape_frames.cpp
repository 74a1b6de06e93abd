#include "app/shape_frames.hpp"

#include "base/errors.hpp"
#ifdef NSFRAME_HAS_VTK
#include "output/vtk_frames.hpp"
#endif

namespace nsframe::app {

void write_shape_frames(const Model& model, State state, const std::vector<VectorX>& shapes, const std::filesystem::path& folder) {
#ifdef NSFRAME_HAS_VTK
  OutputOptions options;
  options.frames = 1;
  VtkFrames frames(folder, options);
  state.time = 0;
  state.displacement.setZero();
  frames.start(model, state);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    State shape = state;
    shape.time = static_cast<double>(i + 1);
    shape.displacement = shapes[i];
    frames.step(state, shape, {}, {});
  }
  frames.finish();
#else
  (void)model; (void)state; (void)shapes; (void)folder;
  throw InputError("error: -o: this nsframe was built without VTK and cannot write shapes");
#endif
}

}  // namespace nsframe::app
