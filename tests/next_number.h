/* Numbers at random, the same in every run. */
#ifndef BILLOW_TESTS_NEXT_NUMBER_H
#define BILLOW_TESTS_NEXT_NUMBER_H

#include <stdint.h>

/* Between -1 and 1. */
static inline double next_number(void)
{
    static uint64_t seed = 88172645463325252u;
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) * 0x1p-52 - 1.0;
}

#endif
