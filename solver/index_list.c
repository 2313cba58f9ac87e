/* Growing lists of indices. */
#include "solver/memory.h"
#include "solver/sets.h"

int index_list_add(IndexList *list, int32_t item)
{
    if (memory_reserve((void **)&list->items, &list->capacity, list->count + 1, sizeof *list->items)) return -1;
    list->items[list->count++] = item;
    return 0;
}

void index_list_free(IndexList *list)
{
    memory_free(list->items);
    *list = (IndexList){0};
}
