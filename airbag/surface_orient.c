/* Orientation spreads over every edge that two facets share. */
#include "airbag/surface_internal.h"

#include "solver/memory.h"

int surface_spread(SurfaceWork *work)
{
    edge_table_free(&work->table);
    parity_free(&work->parity);
    if (edge_table_build(work->input, work->active, &work->table) ||
        parity_create(work->input->facet_count, &work->parity)) {
        report_memory(work);
        return -1;
    }
    const EdgeTable *table = &work->table;
    for (int e = 0; e < table->edge_count; e++) {
        const EdgeUse *use = &table->use[table->start[e]];
        if (table->start[e + 1] - table->start[e] != 2) continue;
        /* neighbours of equal winding walk their common edge in opposite directions */
        int relation = use[0].from == use[1].from ? -1 : 1;
        if (!parity_join(&work->parity, use[0].facet, use[1].facet, relation)) {
            report_one_sided(work, use[0].from, use[0].to, use[0].facet, use[1].facet);
            return -1;
        }
    }
    return 0;
}
