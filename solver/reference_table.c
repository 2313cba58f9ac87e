/* Reference coordinates as *AIRBAG_REFERENCE_GEOMETRY gives them. */
#include "solver/reference_table.h"

#include <string.h>

#include "solver/memory.h"

static void scale_about(const ReferenceBlockDefinition *block, const double origin[3], double x[3])
{
    const double scale[3] = {block->sx, block->sy, block->sz};
    for (int k = 0; k < 3; k++)
        if (scale[k] != 1.0) x[k] = origin[k] + scale[k] * (x[k] - origin[k]);
}

int32_t reference_table_origin(const ReferenceTable *table, const ReferenceBlockDefinition *block, int *id)
{
    const Definitions *d = table->definitions;
    *id = block->nid != 0   ? block->nid
          : block->is_shell ? d->reference_shells.items[block->first].node[0]
                            : d->reference_nodes.items[block->first].id;
    return id_map_find(&table->nodes, *id);
}

/* The origin of a block of nodes in the coordinates that the block writes, or else under *NODE. */
static bool find_origin(const ReferenceTable *table, const ReferenceBlockDefinition *block, double origin[3])
{
    const Definitions *d = table->definitions;
    int id;
    int32_t node = reference_table_origin(table, block, &id);
    for (size_t i = block->first + block->count; i-- > block->first;) {
        if (d->reference_nodes.items[i].id != id) continue;
        memcpy(origin, d->reference_nodes.items[i].x, 3 * sizeof *origin);
        return true;
    }
    if (node >= 0) memcpy(origin, d->nodes.items[node].x, 3 * sizeof *origin);
    return node >= 0;
}

static void place_block(ReferenceTable *table, int32_t number)
{
    const Definitions *d = table->definitions;
    const ReferenceBlockDefinition *block = &d->reference_blocks.items[number];
    double origin[3];
    const bool scaled = find_origin(table, block, origin);
    for (size_t i = block->first; i < block->first + block->count; i++) {
        int32_t node = id_map_find(&table->nodes, d->reference_nodes.items[i].id);
        memcpy(table->x + 3 * i, d->reference_nodes.items[i].x, 3 * sizeof *table->x);
        if (scaled) scale_about(block, origin, table->x + 3 * i);
        table->block[i] = number;
        if (node >= 0) table->record[node] = (int32_t)i;
    }
}

int reference_table_build(const Definitions *d, ReferenceTable *table)
{
    *table = (ReferenceTable){.definitions = d};
    size_t records = d->reference_nodes.count, nodes = d->nodes.count;
    table->record = memory_alloc(nodes + 1, sizeof *table->record);
    table->block = memory_alloc(records + 1, sizeof *table->block);
    table->x = memory_alloc(3 * records + 1, sizeof *table->x);
    if (!table->record || !table->block || !table->x ||
        (nodes > 0 && id_map_build(&table->nodes, &d->nodes.items[0].id, nodes, sizeof *d->nodes.items, NULL))) {
        reference_table_free(table);
        return -1;
    }
    for (size_t n = 0; n < nodes; n++) table->record[n] = -1;
    for (size_t i = 0; i < d->reference_blocks.count; i++)
        if (!d->reference_blocks.items[i].is_shell) place_block(table, (int32_t)i);
    return 0;
}

void reference_table_node(const ReferenceTable *table, int32_t node, double x[3])
{
    int32_t record = table->record[node];
    memcpy(x, record >= 0 ? table->x + 3 * (ptrdiff_t)record : table->definitions->nodes.items[node].x, 3 * sizeof *x);
}

void reference_table_scale(const ReferenceTable *table, const ReferenceBlockDefinition *block, double x[3])
{
    double origin[3];
    int id;
    int32_t node = reference_table_origin(table, block, &id);
    if (node < 0) return;
    reference_table_node(table, node, origin);
    scale_about(block, origin, x);
}

void reference_table_free(ReferenceTable *table)
{
    id_map_free(&table->nodes);
    memory_free(table->record);
    memory_free(table->block);
    memory_free(table->x);
    *table = (ReferenceTable){0};
}
