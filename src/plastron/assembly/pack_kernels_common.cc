#define PLASTRON_PACK_KERNELS common_kernels
#define PLASTRON_PACK_NAMESPACE common_packs
#define PLASTRON_PACK_INSTRUCTIONS "common"
#define PLASTRON_PACK_LANES 2
#include <plastron/assembly/pack_formulas.hpp>
