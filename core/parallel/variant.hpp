// Names of a kernel's compiled variants: PROVETA_VARIANT(name) is name followed by the suffix that the build gives, as in name_avx2.
#pragma once

#define PROVETA_JOIN_NOW(a, b) a##b
#define PROVETA_JOIN(a, b) PROVETA_JOIN_NOW(a, b)
#define PROVETA_VARIANT(name) PROVETA_JOIN(name, PROVETA_SUFFIX)
