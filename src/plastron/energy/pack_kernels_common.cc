// The kernels that every processor can run, and the choice among all kernels.
#define PLASTRON_PACK_KERNELS common_kernels
#define PLASTRON_PACK_NAMESPACE common_packs
#define PLASTRON_PACK_INSTRUCTIONS "common"
#define PLASTRON_PACK_LANES 2
#include <plastron/energy/pack_formulas.hpp>

#include <vector>

namespace plastron::energy {

#ifdef __x86_64__
// Each is in its own object file because the compiler gets the instructions by file (src/plastron/CMakeLists.txt).
extern const PackKernels avx2_kernels;
extern const PackKernels avx512_kernels;
#endif

std::span<const PackKernels* const> pack_kernels() {
  static const std::vector<const PackKernels*> available = [] {
    std::vector<const PackKernels*> kernels;
#ifdef __x86_64__
    __builtin_cpu_init();
    const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (has_avx2 && __builtin_cpu_supports("avx512f")) kernels.push_back(&avx512_kernels);
    if (has_avx2) kernels.push_back(&avx2_kernels);
#endif
    kernels.push_back(&common_kernels);
    return kernels;
  }();
  return available;
}

}  // namespace plastron::energy
