#pragma once

// Inner loops are compiled for wider registers as well and chosen when the program starts. (Sanitizers run too late for
// that choice.) Results are the same to the last bit: nothing is contracted or reordered.
#if defined(__x86_64__) && !defined(RINKAKU_SANITIZED)
#define RINKAKU_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define RINKAKU_WIDE
#endif
