/* Triangles and edges of an interface as the narrow phase wants them: all that it needs of one lies in one place. */
#include "contact/contact_loop.h"
#include "solver/memory.h"

int contact_records_create(ContactRun *run)
{
    const ContactInterface *c = run->contact;
    size_t triangles = (size_t)c->triangle_count, edges = (size_t)c->edge_count;
    run->triangle = memory_alloc(triangles + 1, sizeof *run->triangle);
    run->edge = memory_alloc(edges + 1, sizeof *run->edge);
    run->ring = memory_alloc(6 * triangles + 1, sizeof *run->ring);
    run->radius = memory_alloc(triangles + edges + 1, sizeof *run->radius);
    return run->triangle && run->edge && run->ring && run->radius ? 0 : -1;
}

void contact_records_free(ContactRun *run)
{
    memory_free(run->triangle);
    memory_free(run->edge);
    memory_free(run->ring);
    memory_free(run->radius);
}

/* The place of a radius among those kept; neighbouring items mostly share theirs. */
static int32_t keep_radius(double *kept, int32_t *count, double radius)
{
    if (*count == 0 || kept[*count - 1] != radius) kept[(*count)++] = radius;
    return *count - 1;
}

/* The two corners that follow a node in each triangle of its fan. */
static void fill_rings(ContactRun *run, int nodes)
{
    const ContactInterface *c = run->contact;
    for (int n = 0; n < nodes; n++)
        for (int32_t k = c->fan_start[n]; k < c->fan_start[n + 1]; k++) {
            const int32_t *corner = c->triangle + 3 * (ptrdiff_t)c->fan[k];
            int first = corner[1] == n ? 1 : corner[2] == n ? 2 : 0;
            for (int i = 0; i < 2; i++) run->ring[2 * (ptrdiff_t)k + i] = corner[(first + 1 + i) % 3];
        }
}

void contact_records_fill(ContactRun *run, const Model *model)
{
    const ContactInterface *c = run->contact;
    const double *inverse = model->contact_inverse;
    int32_t radii = 0;
    for (int t = 0; t < c->triangle_count; t++) {
        ContactTriangle *to = &run->triangle[t];
        *to = (ContactTriangle){.radius = keep_radius(run->radius, &radii, c->triangle_radius[t])};
        for (int k = 0; k < 3; k++) {
            const ptrdiff_t at = 3 * (ptrdiff_t)t + k;
            to->corner[k] = c->triangle[at];
            to->neighbour[k] = c->neighbour[at];
            to->rims |= (unsigned char)(c->corner_rim[at] << k);
            to->moves = to->moves || inverse[c->triangle[at]] > 0.0;
        }
    }
    for (int e = 0; e < c->edge_count; e++) {
        const int32_t *ends = c->edge + 2 * (ptrdiff_t)e;
        run->edge[e] = (ContactEdge){.node = {ends[0], ends[1]},
                                     .radius = keep_radius(run->radius, &radii, c->edge_radius[e]),
                                     .moves = inverse[ends[0]] > 0.0 || inverse[ends[1]] > 0.0};
    }
    fill_rings(run, model->node_count);
}
