#ifdef __x86_64__
#define PLASTRON_PACK_KERNELS avx512_kernels
#define PLASTRON_PACK_NAMESPACE avx512_packs
#define PLASTRON_PACK_INSTRUCTIONS "AVX-512"
#define PLASTRON_PACK_LANES 8
#include <plastron/energy/pack_formulas.hpp>
#endif
