/* The allocator: 64-byte aligned zeroed blocks with their size kept in front, counted, with a failure hook for tests.
 */
#define _DEFAULT_SOURCE /* madvise */
#include "solver/memory.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum {
    BLOCK_ALIGNMENT = 64,
    HUGE_PAGE = 1 << 21,
    LEAST_LARGE = 1 << 19 /* blocks of this size and more get huge pages of their own */
};

/* Sits in the 64 bytes before the block. */
typedef struct BlockHeader {
    size_t bytes;
} BlockHeader;

/* The counters behind memory_in_use, memory_peak and memory_fail_after: the interface's only state. */
static atomic_size_t bytes_held, bytes_peak;
static atomic_long failure_countdown;

static BlockHeader *block_header(void *block)
{
    return (BlockHeader *)(void *)((unsigned char *)block - BLOCK_ALIGNMENT);
}

static bool failure_is_due(void)
{
    if (atomic_load_explicit(&failure_countdown, memory_order_relaxed) == 0) return false;
    return atomic_fetch_sub(&failure_countdown, 1) == 1;
}

static void count_bytes(size_t bytes)
{
    size_t held = atomic_fetch_add(&bytes_held, bytes) + bytes;
    size_t peak = atomic_load(&bytes_peak);
    while (held > peak && !atomic_compare_exchange_weak(&bytes_peak, &peak, held)) {
    }
}

/* A block of undefined content, or NULL; *bytes receives its size. */
static void *allocate_block(size_t count, size_t size, size_t *bytes)
{
    if (size != 0 && count > (SIZE_MAX / 2 - BLOCK_ALIGNMENT) / size) return NULL;
    if (failure_is_due()) return NULL;
    *bytes = count * size;
    void *raw = NULL;
    const bool large = *bytes >= LEAST_LARGE;
    size_t room = BLOCK_ALIGNMENT + *bytes;
    if (large) room = (room + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
    if (posix_memalign(&raw, large ? HUGE_PAGE : BLOCK_ALIGNMENT, room) != 0) return NULL;
#ifdef MADV_HUGEPAGE
    /* the loop walks through the whole model in every cycle: scattered small pages cost it a tenth and more, now and
     * then. A system that has no huge pages to give does without. */
    if (large) (void)madvise(raw, room, MADV_HUGEPAGE);
#endif
    void *block = (unsigned char *)raw + BLOCK_ALIGNMENT;
    block_header(block)->bytes = *bytes;
    count_bytes(*bytes);
    return block;
}

void *memory_alloc(size_t count, size_t size)
{
    size_t bytes = 0;
    void *block = allocate_block(count, size, &bytes);
    if (block) memset(block, 0, bytes);
    return block;
}

void *memory_resize(void *block, size_t count, size_t size)
{
    size_t bytes = 0;
    void *larger = allocate_block(count, size, &bytes);
    if (!larger) return NULL;
    if (block) {
        size_t old = block_header(block)->bytes;
        memcpy(larger, block, old < bytes ? old : bytes);
        memory_free(block);
    }
    return larger;
}

int memory_reserve(void **array, size_t *capacity, size_t needed, size_t size)
{
    if (needed <= *capacity) return 0;
    size_t room = *capacity < 8 ? 8 : *capacity;
    while (room < needed) room = room > SIZE_MAX / 2 ? needed : 2 * room;
    void *larger = memory_resize(*array, room, size);
    if (!larger) return -1;
    *array = larger;
    *capacity = room;
    return 0;
}

void memory_free(void *block)
{
    if (!block) return;
    atomic_fetch_sub(&bytes_held, block_header(block)->bytes);
    free(block_header(block));
}

void memory_fail_after(long countdown)
{
    atomic_store(&failure_countdown, countdown);
}

size_t memory_in_use(void)
{
    return atomic_load(&bytes_held);
}

size_t memory_peak(void)
{
    return atomic_load(&bytes_peak);
}
