/* The shape of a *CONTACT_ENTITY, and where it is. */
#include <math.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/memory.h"
#include "solver/vector3.h"

static const char KEYWORD[] = "*CONTACT_ENTITY";

#define REFUSE(b, source, ...) (diagnostics_add((b)->diagnostics, SEVERITY_ERROR, source, KEYWORD, __VA_ARGS__), -1)

/* Axes of the local system, as rows: A, then B across it. */
static int find_axes(Builder *b, const EntityDefinition *d, double axes[9])
{
    memcpy(axes, d->a, 3 * sizeof *axes);
    double size = vector3_normalize(axes), other = vector3_norm(d->b);
    vector3_cross(axes, d->b, axes + 6);
    bool good = size > 0.0 && vector3_normalize(axes + 6) > 1e-6 * other;
    if (!good)
        return REFUSE(b, d->card3,
                      "the directions A (AX, AY, AZ) = (%g, %g, %g) and B (BX, BY, BZ) = (%g, %g, %g) make no local "
                      "system; give 1, 0, 0 and 0, 1, 0 for the global one",
                      d->a[0], d->a[1], d->a[2], d->b[0], d->b[1], d->b[2]);
    vector3_cross(axes + 6, axes, axes + 3);
    return 0;
}

/* Turns the axes so that the third is the direction of the shape's normal or axis, given in the local system. */
static int turn_axes(Builder *b, const EntityDefinition *d, double axes[9])
{
    double n[3], l[3] = {0.0, 0.0, 0.0};
    matrix3_apply_transposed(axes, d->g + 3, n);
    if (!(vector3_normalize(n) > 0.0))
        return REFUSE(b, d->card5, "%s",
                      d->geotyp == 1 ? "the normal of the plane (G4, G5, G6) is zero; it points to where the nodes are"
                                     : "the axis of the cylinder (G4, G5, G6) is zero; give its direction");
    l[fabs(n[0]) < 0.6 ? 0 : 1] = 1.0;
    vector3_cross(n, l, axes + 3);
    vector3_normalize(axes + 3);
    vector3_cross(axes + 3, n, axes);
    memcpy(axes + 6, n, sizeof n);
    return 0;
}

/* GEOTYP 9: the faces of the part, which must be a closed convex surface. */
static int find_hull(Builder *b, const EntityDefinition *d, ContactEntity *entity)
{
    int32_t part = id_map_find(&b->index.parts, d->pid);
    if (part < 0) return -1; /* reported */
    int32_t first = b->index.part_shell_start[part], count = b->index.part_shell_start[part + 1] - first;
    int32_t *facet = memory_alloc(4 * (size_t)count + 1, sizeof *facet);
    ConvexHull *hull = &entity->hull;
    HullKind kind = HULL_OPEN;
    int status = -1;
    for (int32_t i = 0; facet && i < count; i++) {
        const ShellRecord *r = &b->records[b->index.part_shell[first + i]];
        for (int a = 0; a < 4; a++) facet[4 * i + a] = r->node[a < r->corner_count ? a : 2];
    }
    if (facet) status = convex_hull_make(count, facet, b->x, hull, &kind);
    memory_free(facet);
    if (status) return -1;
    if (builder_adopt(b, hull->corner) | builder_adopt(b, hull->plane) | builder_adopt(b, hull->triangle) |
        builder_adopt(b, hull->side))
        return -1;
    memcpy(entity->origin, hull->origin, sizeof entity->origin);
    for (int k = 0; k < 3; k++) entity->size[k] = hull->radius;
    for (int k = 0; k < 3; k++) entity->axes[4 * k] = 1.0;
    if (kind == HULL_CONVEX) return 0;
    return REFUSE(b, d->card1, "GEOTYP = 9: the mesh of part %d %s", d->pid,
                  kind == HULL_OPEN   ? "is not closed; close it, or use a *CONTACT"
                  : kind == HULL_FLAT ? "encloses nothing; use a *CONTACT"
                                      : "is not convex; use a *CONTACT, which meets its faces");
}

/* The points of the curve that G1 names, scaled: general x-y data or a function's. */
static int outline_points(Builder *b, const EntityDefinition *d, int *count, double **z, double **r)
{
    const CurveDefinition *curve = NULL;
    const Definitions *all = b->definitions;
    for (size_t i = 0; i < all->outlines.count; i++)
        if (all->outlines.items[i].id == (int)d->g[0]) curve = &all->outlines.items[i];
    if (!curve) {
        int found = deck_index_curve(&b->index, (int)d->g[0], "G1", d->card5, KEYWORD, b->diagnostics);
        if (found < 0) return -1;
        curve = &all->curves.items[found];
    }
    *z = builder_alloc(b, curve->x.count + 1, sizeof **z);
    *r = builder_alloc(b, curve->x.count + 1, sizeof **r);
    if (!*z || !*r) return -1;
    int kept = 0;
    for (size_t i = 0; i < curve->x.count; i++) {
        (*z)[kept] = curve->sfa * (curve->x.items[i] + curve->offa);
        (*r)[kept] = curve->sfo * (curve->y.items[i] + curve->offo);
        if (kept == 0 || (*z)[kept] != (*z)[kept - 1] || (*r)[kept] != (*r)[kept - 1]) kept++;
    }
    *count = kept;
    return 0;
}

/* GEOTYP 11: a body of revolution about the third axis. */
static int find_profile(Builder *b, const EntityDefinition *d, ContactEntity *entity)
{
    static const char *const faults[] = {
        [PROFILE_SHORT] = "has less than two different points; give the radius over the place on the third axis",
        [PROFILE_NEGATIVE] = "has a radius below 0; give the place on the third axis first, then the radius",
        [PROFILE_ON_AXIS] = "has a point on the axis between its ends, or nothing off the axis; part it into two "
                            "entities there",
        [PROFILE_CROSSES] = "crosses or touches itself; give its points in their order along the outline",
        [PROFILE_FLAT] = "has no inside; let it run along the third axis"};
    double *z, *r;
    int count, where;
    ProfileFault fault;
    if (outline_points(b, d, &count, &z, &r)) return -1;
    if (revolved_profile_make(count, z, r, &entity->profile, &fault, &where)) return -1;
    if (fault != PROFILE_FINE)
        return REFUSE(b, d->card5, "G1 = %d: the profile, point %d at z = %g with r = %g, %s", (int)d->g[0], where + 1,
                      z[where], r[where], faults[fault]);
    if (builder_adopt(b, entity->profile.edge)) return -1;
    entity->size[0] = entity->profile.reach;
    entity->open = revolved_profile_open(&entity->profile, 0) || revolved_profile_open(&entity->profile, 1);
    return 0;
}

/* A length of the shape that must be positive. */
static int check_length(Builder *b, const EntityDefinition *d, int field, const char *what)
{
    if (d->g[field - 1] > 0.0) return 0;
    return REFUSE(b, d->card5, "G%d = %g: %s must be positive", field, d->g[field - 1], what);
}

static int find_sizes(Builder *b, const EntityDefinition *d, ContactEntity *entity)
{
    const double *g = d->g;
    int status = 0;
    switch (entity->shape) {
    case ENTITY_SPHERE:
        status = check_length(b, d, 4, "the radius of the sphere");
        break;
    case ENTITY_CYLINDER:
        status = check_length(b, d, 7, "the radius of the cylinder");
        break;
    case ENTITY_ELLIPSOID:
        for (int k = 0; k < 3 && !status; k++) status = check_length(b, d, 4 + k, "half an axis of the ellipsoid");
        if (g[6] != 0.0 && g[6] != 2.0)
            status = REFUSE(b, d->card5,
                            "G7 = %g, the order of the ellipsoid, must be 2 (or blank): other orders are "
                            "not there",
                            g[6]);
        break;
    case ENTITY_TORUS:
        status = check_length(b, d, 4, "the radius of the torus, from its axis to the middle of the tube,") |
                 check_length(b, d, 5, "the radius of the tube");
        if (!status && g[4] > g[3])
            status = REFUSE(b, d->card5,
                            "G5 = %g, the radius of the tube, is larger than G4 = %g, the radius of the "
                            "torus from its axis to the middle of the tube; such a torus cuts itself",
                            g[4], g[3]);
        break;
    case ENTITY_RECTANGLE:
        status = check_length(b, d, 1, "the side of the finite plane along A") |
                 check_length(b, d, 2, "the side of the finite plane along B");
        break;
    default:
        break;
    }
    for (int k = 0; k < 3; k++)
        entity->size[k] = entity->shape == ENTITY_CYLINDER ? g[6] : entity->shape == ENTITY_SPHERE ? g[3] : g[3 + k];
    if (entity->shape == ENTITY_TORUS) entity->size[2] = 0.0;
    if (entity->shape == ENTITY_RECTANGLE) {
        for (int k = 0; k < 3; k++) entity->size[k] = k < 2 ? 0.5 * g[k] : 0.0;
        entity->open = true;
    }
    return status;
}

int build_entity_shape(Builder *b, const EntityDefinition *d, ContactEntity *entity)
{
    static const EntityShape shapes[] = {
        [1] = ENTITY_PLANE, [2] = ENTITY_SPHERE, [3] = ENTITY_CYLINDER,   [4] = ENTITY_ELLIPSOID,
        [5] = ENTITY_TORUS, [9] = ENTITY_HULL,   [10] = ENTITY_RECTANGLE, [11] = ENTITY_PROFILE};
    double moved[3];
    entity->shape = shapes[d->geotyp];
    if (entity->shape == ENTITY_HULL) return find_hull(b, d, entity);
    if (find_axes(b, d, entity->axes)) return -1;
    matrix3_apply_transposed(entity->axes, d->g, moved);
    bool placed = entity->shape != ENTITY_RECTANGLE && entity->shape != ENTITY_PROFILE; /* G1 to G3 are a place */
    for (int k = 0; k < 3; k++) entity->origin[k] = d->centre[k] + (placed ? moved[k] : 0.0);
    if (entity->shape == ENTITY_PROFILE) return find_profile(b, d, entity);
    bool turned = entity->shape == ENTITY_PLANE || entity->shape == ENTITY_CYLINDER;
    if (turned && turn_axes(b, d, entity->axes)) return -1;
    return find_sizes(b, d, entity);
}
