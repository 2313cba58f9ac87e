/* The one allocator of billow, with a hook so that tests can fail the k-th allocation. */
#ifndef BILLOW_MEMORY_H
#define BILLOW_MEMORY_H

#include <stddef.h>

/* Zeroed memory for count items of size bytes, 64-byte aligned; NULL when it cannot be had. Free with memory_free. */
void *memory_alloc(size_t count, size_t size);

/* Grows or shrinks a block to count items of size bytes; new bytes are undefined. NULL leaves the old block alive. */
void *memory_resize(void *block, size_t count, size_t size);

/* Room for at least needed items in a growing array: doubles *capacity as necessary. Returns 0, or -1 without memory
 * (the array is then unchanged). Usage: if (memory_reserve((void **)&a, &cap, n + 1, sizeof *a)) ... */
int memory_reserve(void **array, size_t *capacity, size_t needed, size_t size);

void memory_free(void *block);

/* Test hook: the allocation number countdown from now on fails (1 = the next); 0 switches it off. */
void memory_fail_after(long countdown);

/* Bytes now held and the most ever held, for the memory report. */
size_t memory_in_use(void);
size_t memory_peak(void);

#endif
