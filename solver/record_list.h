/* A growing array of records: item type T, e.g. LIST(NodeDefinition) nodes. Grow with memory_reserve. */
#ifndef BILLOW_RECORD_LIST_H
#define BILLOW_RECORD_LIST_H

#include <stddef.h>

#define LIST(T)                                                                                                        \
    struct {                                                                                                           \
        T *items;                                                                                                      \
        size_t count;                                                                                                  \
        size_t capacity;                                                                                               \
    }

#endif
