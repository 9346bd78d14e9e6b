// The kernels for machines with AVX2; compiled for those, so nothing else may stand here.
#include "plugins/muriel/beam_loops.hpp"

namespace cairn::muriel {

extern const Kernels kAvx2Kernels;
const Kernels kAvx2Kernels = kKernels;

}  // namespace cairn::muriel
