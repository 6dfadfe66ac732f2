#ifdef __x86_64__
#define PLASTRON_PACK_KERNELS avx2_kernels
#define PLASTRON_PACK_NAMESPACE avx2_packs
#define PLASTRON_PACK_INSTRUCTIONS "AVX2"
#define PLASTRON_PACK_LANES 4
#include <plastron/energy/pack_formulas.hpp>
#endif
