/* Places of nodes that transformations refer to, read from the blocks loaded so far. */
#include <string.h>

#include "io/deck_loader.h"
#include "io/include_transform.h"
#include "solver/memory.h"

static void read_nodes(DeckLoader *loader, const DeckBlock *block)
{
#define X(letter, index)                                                                                               \
    {                                                                                                                  \
        .name = letter, .type = 'F', .columns = 16, .offset = offsetof(NodePlace, x) + (index) * sizeof(double)        \
    }
    static const FieldSpec fields[] = {
        {.name = "NID", .type = 'I', .columns = 8, .offset = offsetof(NodePlace, id)}, X("X", 0), X("Y", 1), X("Z", 2)};
#undef X
    TextStore *store = loader->deck->store;
    /* Errors are reported when the block itself is read, and the values are wanted as written. */
    Diagnostics ignored = {0};
    DeckBlock plain = *block;
    plain.transform = NULL;
    CardReader cards = {&plain, 0, loader->deck->parameters, &ignored};
    while (card_left(&cards)) {
        NodePlace node = {.transform = block->transform};
        if (card_read(&cards, fields, (int)(sizeof fields / sizeof *fields), &node, false, NULL, NULL)) continue;
        node.transform = block->transform;
        if (memory_reserve((void **)&store->nodes.items, &store->nodes.capacity, store->nodes.count + 1,
                           sizeof *store->nodes.items)) {
            loader_report_memory(loader);
            break;
        }
        store->nodes.items[store->nodes.count++] = node;
    }
    diagnostics_free(&ignored);
}

/* The node's id and place as the main deck sees them. */
static void move_node(NodePlace *node)
{
    node->id = (int)include_transform_scale(node->transform, SCALE_ID_NODE, node->id);
    for (int i = 0; i < 3; i++) node->x[i] = include_transform_scale(node->transform, SCALE_LENGTH, node->x[i]);
    include_transform_point(node->transform, node->x);
}

bool loader_find_node(DeckLoader *loader, const DeckBlock *block, int id, double x[3])
{
    TextStore *store = loader->deck->store;
    const DeckText *deck = loader->deck;
    for (; store->blocks_searched < deck->blocks.count; store->blocks_searched++) {
        const DeckBlock *other = &deck->blocks.items[store->blocks_searched];
        if (strcmp(other->keyword, "*NODE") == 0) read_nodes(loader, other);
    }
    for (size_t i = 0; i < store->nodes.count; i++) {
        NodePlace node = store->nodes.items[i];
        if (!block->transform && node.transform) move_node(&node);
        bool same_frame = !block->transform || node.transform == block->transform;
        if (!same_frame || node.id != id) continue;
        memcpy(x, node.x, sizeof node.x);
        return true;
    }
    return false;
}
