/* Intersections of the mesh as the deck gives it, for billow check. */
#include "contact/mesh_crossing.h"
#include "io/report.h"
#include "solver/definitions.h"
#include "solver/memory.h"

int report_write_crossings(const Model *model, FILE *stream)
{
    if (model->deformable_count == 0) return 0;
    unsigned char *fabric = memory_alloc((size_t)model->element_count, 1);
    if (!fabric) return -1;
    for (int e = 0; e < model->element_count; e++)
        fabric[e] = model->parts[model->element_part[e]].material_kind != MATERIAL_RIGID;
    MeshCrossings found;
    const int status = mesh_find_crossings(model->element_count, model->element_node, model->initial, fabric, &found);
    memory_free(fabric);
    if (status) return status;
    fprintf(stream, "\nIntersections of the mesh\n-------------------------\n");
    if (found.count == 0) {
        fprintf(stream, "none: no shell goes through another one\n");
        return 0;
    }
    fprintf(stream,
            "%d pair%s of shells go through each other; the deepest: %d and %d, by %.3g at (%.6g, %.6g, %.6g)\n",
            found.count, found.count == 1 ? "" : "s", model->element_id[found.facet[0]],
            model->element_id[found.facet[1]], found.depth, found.place[0], found.place[1], found.place[2]);
    return 0;
}
