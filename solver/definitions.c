/* Releases the deck's records. */
#include "solver/definitions.h"

#include <string.h>

#include "solver/memory.h"

static void free_points(CurveDefinition *curve)
{
    memory_free(curve->x.items);
    memory_free(curve->y.items);
    memory_free(curve->lines.items);
}

void definitions_free(Definitions *d)
{
    for (size_t i = 0; i < d->sets.count; i++) {
        memory_free(d->sets.items[i].members.items);
        memory_free(d->sets.items[i].clauses.items);
        memory_free(d->sets.items[i].segments.items);
    }
    for (size_t i = 0; i < d->curves.count; i++) free_points(&d->curves.items[i]);
    for (size_t i = 0; i < d->outlines.count; i++) free_points(&d->outlines.items[i]);
    for (size_t i = 0; i < d->functions.count; i++) memory_free(d->functions.items[i].program.code);
    void *lists[] = {d->nodes.items,
                     d->shells.items,
                     d->parts.items,
                     d->sections.items,
                     d->materials.items,
                     d->hourglasses.items,
                     d->sets.items,
                     d->curves.items,
                     d->outlines.items,
                     d->coordinates.items,
                     d->vectors.items,
                     d->boxes.items,
                     d->adaptivities.items,
                     d->databases.items,
                     d->histories.items,
                     d->spcs.items,
                     d->motions.items,
                     d->velocities.items,
                     d->node_loads.items,
                     d->rigid_loads.items,
                     d->segment_loads.items,
                     d->body_loads.items,
                     d->gravity_parts.items,
                     d->dampings.items,
                     d->airbags.items,
                     d->walls.items,
                     d->solids.items,
                     d->solid_sections.items,
                     d->merges.items,
                     d->extra_nodes.items,
                     d->nodal_bodies.items,
                     d->beams.items,
                     d->beam_sections.items,
                     d->discretes.items,
                     d->discrete_sections.items,
                     d->interactions.items,
                     d->masses.items,
                     d->part_masses.items,
                     d->porosities.items,
                     d->functions.items,
                     d->reference_blocks.items,
                     d->reference_nodes.items,
                     d->reference_shells.items,
                     d->spotwelds.items,
                     d->contacts.items,
                     d->entities.items,
                     d->tied_nodes.items,
                     d->erosions.items};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) memory_free(lists[i]);
    memset(d, 0, sizeof *d);
}
