// Loops over independent pieces of work by OpenMP.
#pragma once

#include <Eigen/Core>

namespace nsframe {

// Threads for what is done structure by structure: one where there is too little to do.
inline int threads_for(int threads, Eigen::Index rows) { return rows < 1000 ? 1 : threads; }

// work(0), ..., work(count - 1), which may not throw, by `threads`, each with a part of the indices that stands together. One thread
// enters no parallel region: that alone would cost a microsecond.
template <class Work>
void parallel_for(int count, int threads, const Work& work) {
  if (threads <= 1) {
    for (int i = 0; i < count; ++i) work(i);
    return;
  }
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int i = 0; i < count; ++i) work(i);
}

}  // namespace nsframe
