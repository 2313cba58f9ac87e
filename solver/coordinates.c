/* Local coordinate systems, vectors and boxes of the *DEFINE keywords. */
#include "solver/coordinates.h"

#include <string.h>

#include "solver/vector3.h"

static const CoordinateSystem GLOBAL_SYSTEM = {{0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, false};

/* Axes from a first axis along `along` (local axis number first) and a vector in the plane of first and second. */
static bool build_axes(const double along[3], const double plane[3], int first, double axes[9])
{
    double e[3][3];
    memcpy(e[0], along, sizeof e[0]);
    double length = vector3_normalize(e[0]), reach = vector3_norm(plane);
    vector3_cross(e[0], plane, e[2]);
    if (!(length > 0) || !(vector3_normalize(e[2]) > 1e-10 * reach)) return false;
    vector3_cross(e[2], e[0], e[1]);
    for (int k = 0; k < 3; k++) memcpy(axes + 3 * ((first + k) % 3), e[k], sizeof e[k]);
    return true;
}

/* Places of the three nodes of *DEFINE_COORDINATE_NODES. */
static int node_places(const DeckIndex *index, const CoordinateDefinition *record, double place[3][3],
                       Diagnostics *diagnostics)
{
    int status = 0;
    for (int k = 0; k < 3; k++) {
        int32_t node = id_map_find(&index->nodes, record->node[k]);
        if (node < 0) {
            diagnostics_add(diagnostics, SEVERITY_ERROR, record->source, "*DEFINE_COORDINATE_NODES",
                            "N%d = %d: there is no node of this id", k + 1, record->node[k]);
            status = -1;
            continue;
        }
        memcpy(place[k], index->definitions->nodes.items[node].x, sizeof place[k]);
    }
    return status;
}

/* Origin, first axis and a vector in the plane, before any outer system. */
static int read_frame(const DeckIndex *index, const CoordinateDefinition *record, double origin[3], double along[3],
                      double plane[3], int *first, Diagnostics *diagnostics)
{
    *first = 0;
    if (record->kind == COORDINATE_NODES) {
        double place[3][3];
        if (node_places(index, record, place, diagnostics)) return -1;
        memcpy(origin, place[0], sizeof place[0]);
        vector3_subtract(place[1], place[0], along);
        vector3_subtract(place[2], place[0], plane);
        *first = record->dir == 'Y' ? 1 : record->dir == 'Z' ? 2 : 0;
    } else if (record->kind == COORDINATE_SYSTEM) {
        memcpy(origin, record->origin, sizeof record->origin);
        vector3_subtract(record->x_point, record->origin, along);
        vector3_subtract(record->xy_point, record->origin, plane);
    } else {
        memset(origin, 0, 3 * sizeof *origin);
        memcpy(along, record->x_point, sizeof record->x_point);
        memcpy(plane, record->xy_point, sizeof record->xy_point);
    }
    return 0;
}

static const char *keyword_of(const CoordinateDefinition *record)
{
    switch (record->kind) {
    case COORDINATE_NODES:
        return "*DEFINE_COORDINATE_NODES";
    case COORDINATE_SYSTEM:
        return "*DEFINE_COORDINATE_SYSTEM";
    default:
        return "*DEFINE_COORDINATE_VECTOR";
    }
}

/* depth guards against systems that are defined in one another. */
static int resolve_system(const DeckIndex *index, int cid, Source user, const char *keyword, int depth,
                          CoordinateSystem *system, Diagnostics *diagnostics)
{
    *system = GLOBAL_SYSTEM;
    if (cid == 0) return 0;
    int32_t found = id_map_find(&index->coordinates, cid);
    if (found < 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, user, keyword,
                        "there is no coordinate system %d; add a *DEFINE_COORDINATE card or correct the id", cid);
        return -1;
    }
    const CoordinateDefinition *record = &index->definitions->coordinates.items[found];
    double along[3], plane[3], axes[9];
    int first;
    if (depth > 8) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, record->source, keyword_of(record),
                        "coordinate system %d is defined in terms of itself (CIDL)", cid);
        return -1;
    }
    if (read_frame(index, record, system->origin, along, plane, &first, diagnostics)) return -1;
    if (!build_axes(along, plane, first, axes)) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, record->source, keyword_of(record),
                        "the points of coordinate system %d are on one line or coincide; move one of them", cid);
        return -1;
    }
    CoordinateSystem outer = GLOBAL_SYSTEM;
    if (record->kind != COORDINATE_NODES && record->cidl > 0 &&
        resolve_system(index, record->cidl, record->source, keyword_of(record), depth + 1, &outer, diagnostics))
        return -1;
    for (int k = 0; k < 3; k++) matrix3_apply_transposed(outer.axes, axes + 3 * k, system->axes + 3 * k);
    double shift[3];
    matrix3_apply_transposed(outer.axes, system->origin, shift);
    for (int i = 0; i < 3; i++) system->origin[i] = outer.origin[i] + shift[i];
    system->moves = record->kind == COORDINATE_NODES ? record->flag == 1 : record->nid > 0;
    return 0;
}

int coordinates_resolve_system(const DeckIndex *index, int cid, Source user, const char *keyword,
                               CoordinateSystem *system, Diagnostics *diagnostics)
{
    return resolve_system(index, cid, user, keyword, 0, system, diagnostics);
}

int coordinates_resolve_vector(const DeckIndex *index, int vid, Source user, const char *keyword, double vector[3],
                               Diagnostics *diagnostics)
{
    int32_t found = id_map_find(&index->vectors, vid);
    if (found < 0) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, user, keyword,
                        "there is no vector %d; add a *DEFINE_VECTOR or correct VID", vid);
        return -1;
    }
    const VectorDefinition *record = &index->definitions->vectors.items[found];
    CoordinateSystem system;
    if (coordinates_resolve_system(index, record->cid, record->source, "*DEFINE_VECTOR", &system, diagnostics))
        return -1;
    double local[3];
    vector3_subtract(record->head, record->tail, local);
    matrix3_apply_transposed(system.axes, local, vector);
    if (!(vector3_normalize(vector) > 0)) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, record->source, "*DEFINE_VECTOR",
                        "head and tail of vector %d coincide; it has no direction", vid);
        return -1;
    }
    return 0;
}

const BoxDefinition *coordinates_resolve_box(const DeckIndex *index, int box_id, Source user, const char *keyword,
                                             Diagnostics *diagnostics)
{
    int32_t found = id_map_find(&index->boxes, box_id);
    if (found >= 0) return &index->definitions->boxes.items[found];
    diagnostics_add(diagnostics, SEVERITY_ERROR, user, keyword,
                    "there is no box %d; add a *DEFINE_BOX or correct the id", box_id);
    return NULL;
}

bool coordinates_in_box(const BoxDefinition *box, const double x[3])
{
    for (int i = 0; i < 3; i++) {
        if (x[i] < box->low[i] || x[i] > box->high[i]) return false;
    }
    return true;
}
