/* The report of rigid parts' shapes: closed and convex or not, spheres by their corners, parts that lie in each other.
 */
#include <math.h>
#include <string.h>

#include "contact/convex_hull.h"
#include "io/report.h"
#include "solver/definitions.h"
#include "solver/memory.h"
#include "solver/vector3.h"

/* Corners that differ by less than this share from one distance are those of a sphere. */
#define SPHERE_SHARE 1e-3

/* The shape of a part's shells; a part that is not rigid or has none: HULL_OPEN. 0, or -1 without memory. */
static int make_hull(const Model *model, int part, ConvexHull *hull, HullKind *kind)
{
    int count = 0;
    *kind = HULL_OPEN;
    *hull = (ConvexHull){0};
    if (model->parts[part].material_kind != MATERIAL_RIGID) return 0;
    int32_t *facet = memory_alloc(4 * (size_t)model->element_count + 1, sizeof *facet);
    if (!facet) return -1;
    for (int e = 0; e < model->element_count; e++)
        if (model->element_part[e] == part)
            memcpy(facet + 4 * (ptrdiff_t)count++, model->element_node + 4 * (ptrdiff_t)e, 4 * sizeof *facet);
    int status = convex_hull_make(count, facet, model->initial, hull, kind);
    memory_free(facet);
    return status;
}

/* Radius of the sphere about the origin that all corners lie on, 0 if there is none. */
static double sphere_radius(const ConvexHull *hull)
{
    double least = hull->radius;
    for (int c = 0; c < hull->corner_count; c++) least = fmin(least, vector3_norm(hull->corner + 3 * (ptrdiff_t)c));
    bool round = hull->corner_count > 20 && least > (1.0 - SPHERE_SHARE) * hull->radius;
    return round ? hull->radius : 0.0;
}

static void write_shape(const Model *model, int part, const ConvexHull *hull, HullKind kind, FILE *stream)
{
    static const char *const words[] = {"closed and convex", "not closed", "closed, not convex", "flat"};
    const double radius = kind == HULL_CONVEX ? sphere_radius(hull) : 0.0;
    fprintf(stream, "  part %d: %s", model->parts[part].id, words[kind]);
    if (radius > 0.0)
        fprintf(
            stream,
            ", a sphere of radius %.6g about (%.6g, %.6g, %.6g) by its corners; GEOTYP = 2 of *CONTACT_ENTITY meets "
            "a smooth one",
            radius, hull->origin[0], hull->origin[1], hull->origin[2]);
    fputc('\n', stream);
}

/* Pairs of convex parts of different bodies that lie in each other. */
static void write_overlaps(const Model *model, const ConvexHull *hulls, const HullKind *kinds, FILE *stream)
{
    for (int p = 0; p < model->part_count; p++)
        for (int q = p + 1; q < model->part_count; q++) {
            double place[3];
            int body = model->parts[p].rigid_body;
            if (kinds[p] != HULL_CONVEX || kinds[q] != HULL_CONVEX) continue;
            if (body >= 0 && body == model->parts[q].rigid_body) continue;
            double depth = convex_hull_overlap(&hulls[p], &hulls[q], place);
            if (depth > 0.0)
                fprintf(stream,
                        "  parts %d and %d lie in each other at the start, by up to %.4g at (%.6g, %.6g, %.6g)\n",
                        model->parts[p].id, model->parts[q].id, depth, place[0], place[1], place[2]);
        }
}

int report_write_rigid_shapes(const Model *model, FILE *stream)
{
    int rigid = 0, status = 0;
    for (int p = 0; p < model->part_count; p++)
        rigid += model->parts[p].material_kind == MATERIAL_RIGID && model->parts[p].element_count > 0;
    if (rigid == 0) return 0;
    ConvexHull *hulls = memory_alloc((size_t)model->part_count, sizeof *hulls);
    HullKind *kinds = memory_alloc((size_t)model->part_count, sizeof *kinds);
    if (!hulls || !kinds) status = -1;
    for (int p = 0; p < model->part_count && !status; p++) status = make_hull(model, p, &hulls[p], &kinds[p]);
    if (!status) fprintf(stream, "\nShapes of rigid parts\n---------------------\n");
    for (int p = 0; p < model->part_count && !status; p++)
        if (model->parts[p].material_kind == MATERIAL_RIGID && model->parts[p].element_count > 0)
            write_shape(model, p, &hulls[p], kinds[p], stream);
    if (!status) write_overlaps(model, hulls, kinds, stream);
    for (int p = 0; p < model->part_count && hulls; p++) convex_hull_free(&hulls[p]);
    memory_free(hulls);
    memory_free(kinds);
    return status;
}
