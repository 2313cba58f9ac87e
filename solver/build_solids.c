/* Solids of rigid parts: the mass at each corner by the shape functions of the hexahedron (M22). */
#include <math.h>

#include "solver/builder.h"
#include "solver/vector3.h"

static const int corner_sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/* Shape functions and the determinant of the Jacobian at a point of the natural cube. */
static double shape_functions(double x[8][3], const double at[3], double shape[8])
{
    double jacobian[3][3] = {{0}}, cross[3];
    for (int a = 0; a < 8; a++) {
        const int *sign = corner_sign[a];
        double factor[3];
        for (int i = 0; i < 3; i++) factor[i] = 0.5 * (1.0 + sign[i] * at[i]);
        shape[a] = factor[0] * factor[1] * factor[2];
        for (int i = 0; i < 3; i++) {
            double slope = 0.5 * sign[i] * factor[(i + 1) % 3] * factor[(i + 2) % 3];
            for (int k = 0; k < 3; k++) jacobian[i][k] += slope * x[a][k];
        }
    }
    vector3_cross(jacobian[1], jacobian[2], cross);
    return vector3_dot(jacobian[0], cross);
}

/* Volume that each corner stands for: eight Gauss points are exact for straight-edged solids of any shape. Returns the
 * volume. */
static double corner_volumes(double x[8][3], double share[8])
{
    double volume = 0.0, root = sqrt(1.0 / 3.0);
    for (int a = 0; a < 8; a++) share[a] = 0.0;
    for (int point = 0; point < 8; point++) {
        double at[3], shape[8];
        for (int i = 0; i < 3; i++) at[i] = root * corner_sign[point][i];
        double weight = shape_functions(x, at, shape);
        volume += weight;
        for (int a = 0; a < 8; a++) share[a] += weight * shape[a];
    }
    return volume;
}

static int build_solid(Builder *b, const SolidDefinition *definition, Solid *solid)
{
    double x[8][3];
    solid->part = id_map_find(&b->index.parts, definition->part);
    if (solid->part < 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*ELEMENT_SOLID",
                        "solid %d belongs to part PID = %d, which the deck does not define", definition->id,
                        definition->part);
        return -1;
    }
    const PartRecord *part = &b->parts[solid->part];
    if (part->material < 0 || b->definitions->materials.items[part->material].kind != MATERIAL_RIGID) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*ELEMENT_SOLID",
                        "solid %d is of part %d, which is not rigid; billow has solids for *MAT_RIGID only",
                        definition->id, definition->part);
        return -1;
    }
    for (int a = 0; a < 8; a++) {
        solid->node[a] = id_map_find(&b->index.nodes, definition->node[a]);
        if (solid->node[a] < 0) {
            diagnostics_add(
                b->diagnostics, SEVERITY_ERROR, definition->source, "*ELEMENT_SOLID",
                "solid %d names node N%d = %d, which the deck does not define; add it under *NODE or correct "
                "the element",
                definition->id, a + 1, definition->node[a]);
            return -1;
        }
        for (int k = 0; k < 3; k++) x[a][k] = b->x[3 * solid->node[a] + k];
    }
    double volume = corner_volumes(x, solid->share);
    if (!(volume > 0.0)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*ELEMENT_SOLID",
                        "solid %d has the volume %g; order its nodes so that N1 to N4 lie below N5 to N8",
                        definition->id, volume);
        return -1;
    }
    for (int a = 0; a < 8; a++) solid->share[a] *= part->density;
    b->model->parts[solid->part].mass += part->density * volume;
    return 0;
}

int build_solids(Builder *b)
{
    const Definitions *d = b->definitions;
    Model *m = b->model;
    int status = 0;
    if (d->solids.count == 0) return 0;
    if (!b->x) return -1; /* no nodes: told by build_shells */
    m->solids = builder_alloc(b, d->solids.count, sizeof *m->solids);
    if (!m->solids) return -1;
    m->solid_count = (int)d->solids.count;
    for (size_t i = 0; i < d->solids.count; i++)
        if (build_solid(b, &d->solids.items[i], &m->solids[i])) status = -1;
    return status;
}
