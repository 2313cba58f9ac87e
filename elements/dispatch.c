/* Chooses the kernel table for the processor. */
#include <stdlib.h>
#include <string.h>

#include "elements/kernels.h"

extern const KernelTable kernel_table_v2, kernel_table_v3, kernel_table_v4;

const KernelTable *kernels_select(const char *wish)
{
    if (!wish) wish = getenv("BILLOW_KERNELS");
    __builtin_cpu_init();
    bool v3 = __builtin_cpu_supports("x86-64-v3") > 0, v4 = __builtin_cpu_supports("x86-64-v4") > 0;
    if (!wish || !*wish) return v4 ? &kernel_table_v4 : v3 ? &kernel_table_v3 : &kernel_table_v2;
    if (strcmp(wish, "v2") == 0) return &kernel_table_v2;
    if (strcmp(wish, "v3") == 0 && v3) return &kernel_table_v3;
    if (strcmp(wish, "v4") == 0 && v4) return &kernel_table_v4;
    return NULL;
}

ElementKernel *kernels_for(const KernelTable *table, const ElementGroup *group)
{
    if (group->law == LAW_SURFACE) return table->surface;
    if (group->law == LAW_CURVE || group->law == LAW_RUBBER) table = table->further;
    switch (group->kind) {
    case ELEMENT_TRIANGLE:
        return table->triangle;
    case ELEMENT_QUAD_FULL:
        return table->quad_full;
    case ELEMENT_QUAD_ONE:
        return table->quad_one;
    }
    return table->surface;
}
