#include "plugins/muriel/beam_kernels.hpp"

#include "plugins/muriel/beam_loops.hpp"

namespace cairn::muriel {

#if defined(CAIRN_HAS_AVX2_KERNELS)
extern const Kernels kAvx2Kernels;
#endif

const Kernels& kernels() {
#if defined(CAIRN_HAS_AVX2_KERNELS)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return kAvx2Kernels;
#endif
  return base_kernels();
}

const Kernels& base_kernels() {
  return kKernels;
}

}  // namespace cairn::muriel
